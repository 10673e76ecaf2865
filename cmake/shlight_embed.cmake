# shlight_embed_shaders(target file…)
#
# Puts shader files into a library at build time, so that programs read no file to draw. `shaders/a_b.vert` becomes the
# string shlight::shaders::a_b_vert of the header "shaders.h", private to the target.
#
# The file runs twice: included, it defines the function; as a script (cmake -P), it writes the header.

if(CMAKE_SCRIPT_MODE_FILE)
  set(header "#pragma once\n\n#include <string_view>\n\nnamespace shlight::shaders {\n")
  foreach(file IN LISTS FILES)
    get_filename_component(name ${file} NAME)
    string(REPLACE "." "_" name ${name})
    # A shader may hold semicolons and brackets, which CMake's lists do not: the text is never taken as a list.
    file(READ ${file} text)
    string(APPEND header "inline constexpr std::string_view ${name} = R\"glsl(${text})glsl\";\n")
  endforeach()
  string(APPEND header "}  // namespace shlight::shaders\n")
  file(WRITE ${OUTPUT} "${header}")
  return()
endif()

set(SHLIGHT_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(shlight_embed_shaders target)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE files)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  add_custom_command(
    OUTPUT ${folder}/shaders.h
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${folder}/shaders.h "-DFILES=${files}" -P ${SHLIGHT_EMBED_SCRIPT}
    DEPENDS ${files} ${SHLIGHT_EMBED_SCRIPT}
    COMMENT "Embedding shaders into ${target}"
    VERBATIM)
  target_sources(${target} PRIVATE ${folder}/shaders.h)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
