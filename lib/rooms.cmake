# The rooms beside the runtime, which have dependencies: each looks for its own.

# vndf_needs(ROOM DEBIAN_PACKAGE NAME ARGUMENTS...) calls find_package(NAME ARGUMENTS...) and stops
# with a message that says what to install if it is missing. GLOBAL, because whoever links our
# libraries from another folder needs the imported targets too.
macro(vndf_needs room debian_package name)
  find_package(${name} ${ARGN} GLOBAL)
  vndf_require(${room} ${debian_package} ${name} "${${name}_FOUND}")
endmacro()

# vndf_require(ROOM DEBIAN_PACKAGE NAME FOUND) is the message of vndf_needs().
function(vndf_require room debian_package name found)
  if(NOT found)
    message(FATAL_ERROR "vndf::${room} needs ${name}, which was not found. On Debian, "
                        "tools/install_packages.sh or `apt-get install ${debian_package}` installs it.")
  endif()
endfunction()

vndf_needs(support libc6-dev Threads)
vndf_room(vndf_support
  vndf/support/csv_reader.cpp
  vndf/support/parallel.cpp
  vndf/support/text.cpp)
target_link_libraries(vndf_support PRIVATE Threads::Threads)

vndf_needs(batch libhwy-dev hwy 1)
vndf_room(vndf_batch
  vndf/batch/sample_batch.cpp)
target_link_libraries(vndf_batch PUBLIC vndf PRIVATE hwy::hwy)
# A batch draws what the kernel draws, bit for bit: no target may fuse a product with a sum.
target_compile_options(vndf_batch PRIVATE -ffp-contract=off)

# The texts that are exported are those of the headers: a change of one makes them again.
set(VNDF_EMBEDDED_TEXTS)
foreach(header vec.h rough_surface.h kernel_language.h kernel_text.h kernel.h kernel_text/shading_language.h
               kernel_text/tables.h kernel_text/sample.h kernel_text/map.h kernel_text/evaluate.h)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/vndf/${header})
  file(READ vndf/${header} text)
  string(APPEND VNDF_EMBEDDED_TEXTS "    {\"vndf/${header}\", R\"vndf(${text})vndf\"},\n")
endforeach()
configure_file(vndf/devices/embedded_text.cpp.in embedded_text.cpp @ONLY)
vndf_room(vndf_devices
  ${CMAKE_CURRENT_BINARY_DIR}/embedded_text.cpp
  vndf/devices/amalgamate.cpp
  vndf/devices/export_source.cpp
  vndf/devices/golden_vectors.cpp
  vndf/devices/kernel_calls.cpp
  vndf/devices/table_text.cpp
  vndf/devices/translate.cpp)
target_link_libraries(vndf_devices PUBLIC vndf)

enable_language(C)  # for FindHDF5
vndf_needs(io libhdf5-dev HDF5 COMPONENTS C)
vndf_needs(io libopenexr-dev OpenEXR 3)
vndf_needs(io zlib1g-dev ZLIB)
vndf_needs(io libpng-dev PNG)
vndf_needs(io libtiff-dev TIFF 4.5)
vndf_room(vndf_io
  vndf/io/atomic_file.cpp
  vndf/io/atomic_folder.cpp
  vndf/io/checksum_trailer.cpp
  vndf/io/content_checksum.cpp
  vndf/io/crc64.cpp
  vndf/io/exr_channels.cpp
  vndf/io/exr_header.cpp
  vndf/io/exr_image.cpp
  vndf/io/exr_lines.cpp
  vndf/io/exr_map.cpp
  vndf/io/exr_map_header.cpp
  vndf/io/exr_reader.cpp
  vndf/io/exr_writer.cpp
  vndf/io/hdf5_dataset.cpp
  vndf/io/hdf5_filters.cpp
  vndf/io/hdf5_group.cpp
  vndf/io/hdf5_object.cpp
  vndf/io/hdf5_reader.cpp
  vndf/io/hdf5_values.cpp
  vndf/io/hdf5_writer.cpp
  vndf/io/inflate.cpp
  vndf/io/map_image.cpp
  vndf/io/map_pixels.cpp
  vndf/io/png_map.cpp
  vndf/io/radiance_image.cpp
  vndf/io/stored_names.cpp
  vndf/io/stored_tables.cpp
  vndf/io/table_file.cpp
  vndf/io/tiff_map.cpp)
target_link_libraries(vndf_io PUBLIC vndf PRIVATE vndf_support OpenEXR::OpenEXR HDF5::HDF5 ZLIB::ZLIB
                                      PNG::PNG TIFF::TIFF)

vndf_needs(distributions libboost-dev Boost 1.74)
vndf_needs(distributions libmuparser-dev muparser)
vndf_room(vndf_distributions
  vndf/distributions/compiled_formula.cpp
  vndf/distributions/diagnose.cpp
  vndf/distributions/families.cpp
  vndf/distributions/family_list.cpp
  vndf/distributions/fit_profile.cpp
  vndf/distributions/formula_distribution.cpp
  vndf/distributions/least_squares_spline.cpp
  vndf/distributions/measured_profile.cpp
  vndf/distributions/mixture.cpp
  vndf/distributions/parse_distribution.cpp
  vndf/distributions/profile_csv.cpp
  vndf/distributions/radial_profile.cpp
  vndf/distributions/shape_invariance.cpp
  vndf/distributions/slope_integrals.cpp
  vndf/distributions/slope_map.cpp
  vndf/distributions/specification.cpp)
target_link_libraries(vndf_distributions PUBLIC vndf vndf_support PRIVATE muparser::muparser)
target_include_directories(vndf_distributions SYSTEM PRIVATE ${Boost_INCLUDE_DIRS})

vndf_room(vndf_precompute
  vndf/precompute/bake_certified.cpp
  vndf/precompute/build_tables.cpp
  vndf/precompute/conditional_distribution.cpp
  vndf/precompute/conditional_shape.cpp
  vndf/precompute/fill_table.cpp
  vndf/precompute/interpolated_density.cpp
  vndf/precompute/make_curve.cpp
  vndf/precompute/marginal_distribution.cpp
  vndf/precompute/marginal_map.cpp
  vndf/precompute/measure_certificate.cpp
  vndf/precompute/measure_kernel_certificate.cpp
  vndf/precompute/place_rows.cpp
  vndf/precompute/rows.cpp
  vndf/precompute/row_errors.cpp
  vndf/precompute/unit_slopes.cpp)
target_link_libraries(vndf_precompute PUBLIC vndf_distributions)
target_include_directories(vndf_precompute SYSTEM PRIVATE ${Boost_INCLUDE_DIRS})

vndf_room(vndf_validate
  vndf/validate/checks/configurations.cpp
  vndf/validate/checks/cross_check.cpp
  vndf/validate/checks/density_check.cpp
  vndf/validate/checks/distribution_check.cpp
  vndf/validate/checks/furnace_check.cpp
  vndf/validate/checks/hard_cases.cpp
  vndf/validate/checks/map_row.cpp
  vndf/validate/checks/quasi_random_check.cpp
  vndf/validate/checks/u_error_check.cpp
  vndf/validate/exact/exact_distribution.cpp
  vndf/validate/exact/normal_quadrature.cpp
  vndf/validate/exact/radial_distribution.cpp
  vndf/validate/experiment/named_estimators.cpp
  vndf/validate/experiment/variance_experiment.cpp
  vndf/validate/pictures/distribution_curves.cpp
  vndf/validate/pictures/sample_weights.cpp
  vndf/validate/pictures/slope_histogram.cpp
  vndf/validate/pictures/u_error_map.cpp
  vndf/validate/record_groups.cpp
  vndf/validate/record_maps.cpp
  vndf/validate/records.cpp
  vndf/validate/sampler/named_samplers.cpp
  vndf/validate/sampler/sampler_under_test.cpp
  vndf/validate/statistics/rank_correlation.cpp
  vndf/validate/statistics/significance.cpp
  vndf/validate/statistics/uniformity.cpp
  vndf/validate/validate.cpp
  vndf/validate/validate_records.cpp)
target_link_libraries(vndf_validate PUBLIC vndf_precompute)
target_include_directories(vndf_validate SYSTEM PRIVATE ${Boost_INCLUDE_DIRS})

if(VNDF_BUILD_TOOLS)
  vndf_needs(bench libbenchmark-dev benchmark)
  vndf_needs(bench libfmt-dev fmt)
  vndf_needs(bench nlohmann-json3-dev nlohmann_json 3)
  vndf_room(vndf_bench
    vndf/bench/caps_batch.cpp
    vndf/bench/cases.cpp
    vndf/bench/collector.cpp
    vndf/bench/cuda_report.cpp
    vndf/bench/label_places.cpp
    vndf/bench/literal_tables.cpp
    vndf/bench/pareto.cpp
    vndf/bench/sample_inputs.cpp
    vndf/bench/speed_panel.cpp
    vndf/bench/speed_plot.cpp
    vndf/bench/speed_report.cpp)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}" build_flags)
  target_compile_definitions(vndf_bench PRIVATE VNDF_BENCH_FLAGS="${build_flags}")
  target_link_libraries(vndf_bench PUBLIC vndf_devices vndf_io vndf_batch vndf_precompute nlohmann_json::nlohmann_json
                                   PRIVATE benchmark::benchmark fmt::fmt hwy::hwy)

  # The benchmark on a GPU, where there is a CUDA compiler. It is called by hand, because CMake 3.25
  # does not know how recent ones are told of C++20.
  find_package(CUDAToolkit QUIET)
  cmake_dependent_option(VNDF_BUILD_CUDA "Build the benchmark on CUDA devices" ON
                         CUDAToolkit_NVCC_EXECUTABLE OFF)
  if(VNDF_BUILD_CUDA)
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/vndf/bench/cuda_bench.cu)
    set(object ${CMAKE_CURRENT_BINARY_DIR}/cuda_bench.o)
    add_custom_command(
      OUTPUT ${object}
      COMMAND ${CUDAToolkit_NVCC_EXECUTABLE} -std=c++20 -O3 -arch=all-major -Xcompiler=-fPIC
              -I ${CMAKE_CURRENT_SOURCE_DIR} -MD -MF ${object}.d -o ${object} -c ${source}
      DEPENDS ${source} DEPFILE ${object}.d COMMENT "Building CUDA object cuda_bench.o" VERBATIM)
    target_sources(vndf_bench PRIVATE ${object})
    target_link_libraries(vndf_bench PRIVATE CUDA::cudart_static)
  else()
    target_sources(vndf_bench PRIVATE vndf/bench/cuda_unavailable.cpp)
  endif()
endif()
