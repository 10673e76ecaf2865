# shlight_embed(target name file…)
#
# Puts texts into a library at build time, so that programs need no files beside them. `shaders/a_b.vert` becomes the
# string shlight::<name>::a_b_vert of the header "<name>.h", private to the target.
#
# The file runs twice: included, it defines the function; as a script (cmake -P), it writes the header.

if(CMAKE_SCRIPT_MODE_FILE)
  get_filename_component(space ${OUTPUT} NAME_WE)
  set(header "#pragma once\n\n#include <string_view>\n\nnamespace shlight::${space} {\n")
  foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME)
    string(REPLACE "." "_" name ${name})
    # A text may hold semicolons and brackets, which CMake's lists do not: it is never taken as a list.
    file(READ ${file} text)
    string(APPEND header "inline constexpr std::string_view ${name} = R\"text(${text})text\";\n")
  endforeach()
  string(APPEND header "}  // namespace shlight::${space}\n")
  file(WRITE ${OUTPUT} "${header}")
  return()
endif()

set(SHLIGHT_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(shlight_embed target name)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE files)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  add_custom_command(
    OUTPUT ${folder}/${name}.h
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${folder}/${name}.h "-DFILES=${files}" -P ${SHLIGHT_EMBED_SCRIPT}
    DEPENDS ${files} ${SHLIGHT_EMBED_SCRIPT}
    COMMENT "Embedding ${name} into ${target}"
    VERBATIM)
  target_sources(${target} PRIVATE ${folder}/${name}.h)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
