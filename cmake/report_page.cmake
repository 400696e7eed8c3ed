# The page of `relock report`: cli/report/page/page.html with its styles, its scripts and uPlot put in, as one text in
# the program. The parts stay files of their own kind, so that editors and linters know them.
set(page_folder ${PROJECT_SOURCE_DIR}/cli/report)
set(page_styles uplot/uPlot.min.css page/page.css)
set(page_scripts uplot/uPlot.iife.min.js page/data.js page/dom.js page/answers.js page/plots.js page/picture.js page/lanes.js
                 page/timelines.js page/why.js page/losses.js page/main.js)

#   relock_page_part(RESULT FILE...): their contents, one after another, read again when they change
function(relock_page_part result)
  set(all "")
  foreach(file IN LISTS ARGN)
    file(READ ${page_folder}/${file} text)
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page_folder}/${file})
    string(APPEND all "${text}\n")
  endforeach()
  set(${result} "${all}" PARENT_SCOPE)
endfunction()

relock_page_part(REPORT_PAGE page/page.html)
relock_page_part(styles ${page_styles})
relock_page_part(scripts ${page_scripts})
relock_page_part(licence uplot/LICENSE)
string(REPLACE "/* styles */" "${styles}" REPORT_PAGE "${REPORT_PAGE}")
string(REPLACE "/* scripts */" "${scripts}" REPORT_PAGE "${REPORT_PAGE}")
string(REPLACE "/* licence */" "${licence}" REPORT_PAGE "${REPORT_PAGE}")
configure_file(cli/report/page/page.cpp.in ${PROJECT_BINARY_DIR}/report_page.cpp @ONLY)
target_sources(relock_cli PRIVATE ${PROJECT_BINARY_DIR}/report_page.cpp)
