# ifsm_layer(<name> SOURCES … [USES <lower layers and packages> …] [PUBLIC_USES …])
# One object library for a folder. Headers are included as "<folder>/<noun>.h". A layer sees the folders of the
# layers that it names, and nothing else: a wrong include fails to compile.
function(ifsm_layer name)
  cmake_parse_arguments(LAYER "" "FOLDER" "SOURCES;USES;PRIVATE_USES" ${ARGN})
  if(NOT LAYER_FOLDER)
    set(LAYER_FOLDER ${name})
  endif()
  add_library(ifsm_${name} OBJECT ${LAYER_SOURCES})
  # A layer's headers are seen through a folder of links made for it alone, so that naming no edge means no path.
  set(view ${PROJECT_BINARY_DIR}/layers/${name})
  file(MAKE_DIRECTORY ${view})
  cmake_path(ABSOLUTE_PATH LAYER_FOLDER NORMALIZE OUTPUT_VARIABLE folder)
  file(CREATE_LINK ${folder} ${view}/${name} SYMBOLIC)
  target_include_directories(ifsm_${name} PUBLIC ${view})
  target_link_libraries(ifsm_${name} PUBLIC ${LAYER_USES} PRIVATE ${LAYER_PRIVATE_USES})
  set_property(GLOBAL APPEND PROPERTY IFSM_LAYERS ifsm_${name})
endfunction()

# ifsm_watch_alignment(<target>): under the undefined-behaviour sanitizer, the checks that other files go without.
function(ifsm_watch_alignment target)
  if(IFSM_SANITIZE MATCHES undefined)
    target_compile_options(${target} PRIVATE -fsanitize=null,alignment)
  endif()
endfunction()
