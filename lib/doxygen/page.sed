# The links of our Markdown pages to headers lead to the HTML pages of these headers.
s|](\(\.\./\)*\(lib/\)\{0,1\}\(vndf/[a-z0-9_/]*\.h\))|](@ref \3)|g
# Doxygen gives headings names of its own, so a link within a page becomes its text.
s|\[\([^]]*\)\](#[a-z0-9-]*)|\1|g
