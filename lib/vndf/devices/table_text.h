// Baked tables as text: the words of their block, and the numbers of kernel::VndfTables as
// statements in the words of the kernel.
#pragma once

#include <string>
#include <string_view>

#include "vndf/kernel_tables.h"

namespace vndf::devices {

/// The statements that set every number of the struct `t`, exactly, but not its block.
std::string number_statements(const kernel::VndfTables& tables);

/// The bytes of `tables` as unsigned numbers of 32 bits, whole words of 16 bytes, as an initialiser
/// without its braces. A word of 16 bytes begins with `open` and ends with `close`.
std::string word_list(const KernelTables& tables, std::string_view open, std::string_view close);

/// How many words of 16 bytes the block of `tables` has; the last is filled with zeros.
std::size_t word_count(const KernelTables& tables);

/// `text` as one line of a comment, which it cannot end or continue.
std::string on_one_line(std::string text);

/// What the tables are, as lines of a comment: distribution, specification, largest u-errors.
std::string about(const KernelTables& tables);

}  // namespace vndf::devices
