# What pages are made of, compiled into the program: the scripts of Debian's packages libjs-dygraphs and libjs-three, ours, and the German headings.
set(GESTELL_JAVASCRIPT /usr/share/javascript CACHE PATH "folder of the packages libjs-dygraphs and libjs-three")
set(libraries
  dygraphs dygraphs/dygraph.min.js
  dygraphs_style dygraphs/dygraph.min.css
  synchronizer dygraphs/src/extras/synchronizer.js
  three three/three.min.js
  orbit_controls three/examples/js/controls/OrbitControls.js)
set(scripts page_script page.js chart_script charts.js machine_script machine.js picture_script pictures.js page_style page.css licence licence.txt)

# gestell_embed(name FILE): the symbols gestell_NAME_begin and gestell_NAME_end about the file's bytes.
set(GESTELL_EMBEDDED "")
set(embedded_files "")
macro(gestell_embed name file)
  string(APPEND GESTELL_EMBEDDED "  .globl gestell_${name}_begin, gestell_${name}_end\n  .hidden gestell_${name}_begin, gestell_${name}_end\n"
    "gestell_${name}_begin:\n  .incbin \"${file}\"\ngestell_${name}_end:\n  .byte 0\n")
  list(APPEND embedded_files "${file}")
endmacro()

set(nothing "${PROJECT_BINARY_DIR}/generated/apps/nothing.js")
file(CONFIGURE OUTPUT "${nothing}" CONTENT "") # renewed by no second configuration
set(GESTELL_DYGRAPHS_VERSION "")
set(GESTELL_THREE_VERSION "")
set(absent "")
while(libraries)
  list(POP_FRONT libraries name path)
  if(EXISTS "${GESTELL_JAVASCRIPT}/${path}")
    file(REAL_PATH "${GESTELL_JAVASCRIPT}/${path}" file)
  else()
    set(file "${nothing}")
    list(APPEND absent "${path}")
  endif()
  gestell_embed(${name} "${file}")
  file(READ "${file}" text)
  if(name STREQUAL dygraphs AND text MATCHES "VERSION=\"([0-9.]+)\"")
    set(GESTELL_DYGRAPHS_VERSION "${CMAKE_MATCH_1}")
  elseif(name STREQUAL three AND text MATCHES "REVISION=\"([0-9]+)\"")
    set(GESTELL_THREE_VERSION "r${CMAKE_MATCH_1}")
  endif()
endwhile()
if(absent AND GESTELL_FEM)
  message(FATAL_ERROR "${GESTELL_JAVASCRIPT} lacks ${absent}: install libjs-dygraphs and libjs-three (.ci/dependencies), or name the folder by GESTELL_JAVASCRIPT")
elseif(absent)
  message(STATUS "${GESTELL_JAVASCRIPT} lacks ${absent}: reports of this build show pictures only")
  set(GESTELL_DYGRAPHS_VERSION "")
  set(GESTELL_THREE_VERSION "")
endif()
while(scripts)
  list(POP_FRONT scripts name path)
  gestell_embed(${name} "${CMAKE_CURRENT_SOURCE_DIR}/interactive/${path}")
endwhile()

gestell_embed(german "${CMAKE_CURRENT_SOURCE_DIR}/text/german.tsv")

set(embedded_source "${PROJECT_BINARY_DIR}/generated/apps/embedded.cc")
configure_file(interactive/embedded.cc.in "${embedded_source}" @ONLY)
set_source_files_properties("${embedded_source}" PROPERTIES OBJECT_DEPENDS "${embedded_files}" SKIP_PRECOMPILE_HEADERS ON
  SKIP_UNITY_BUILD_INCLUSION ON)
