# The page of `relock label`: the files of cli/labelling/page, each as a text in the program, so that they stay files of
# their own kind for editors and linters, and the program needs none beside it.
set(page_folder ${PROJECT_SOURCE_DIR}/cli/labelling/page)
set(LABEL_PAGE_FILES "")

#   relock_label_page_file(FILE MEDIA_TYPE [NAME]): NAME is how the page asks for it; else its own
macro(relock_label_page_file file kind)
  set(name "${file}")
  if(${ARGC} GREATER 2)
    set(name "${ARGV2}")
  endif()
  file(READ ${page_folder}/${file} text)
  set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page_folder}/${file})
  string(APPEND LABEL_PAGE_FILES "    PageFile{\"${name}\", \"${kind}\", R\"~~~(${text})~~~\"},\n")
endmacro()

relock_label_page_file(page.html "text/html; charset=utf-8" "")
relock_label_page_file(page.css "text/css; charset=utf-8")
foreach(script main.js server.js view.js tools.js strip.js)
  relock_label_page_file(${script} "text/javascript; charset=utf-8")
endforeach()
configure_file(cli/labelling/page/page.cpp.in ${PROJECT_BINARY_DIR}/label_page.cpp @ONLY)
target_sources(relock_cli PRIVATE ${PROJECT_BINARY_DIR}/label_page.cpp)
