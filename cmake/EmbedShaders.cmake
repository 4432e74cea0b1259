# winslow_embed_shaders(TARGET): every file of shaders/ becomes a string of the program, so that an
# installed winslow needs no data folder. Run as a script (-DINPUTS=... -DOUTPUT=...) it writes the
# table; included, it adds the rule that does so at build time.
if(CMAKE_SCRIPT_MODE_FILE)
  set(table "")
  foreach(file ${INPUTS})
    get_filename_component(name ${file} NAME)
    file(READ ${file} text)
    string(APPEND table "    {\"${name}\", R\"GLSL(${text})GLSL\"},\n")
  endforeach()
  file(WRITE ${OUTPUT}
       "#include \"gui/render/gl.h\"\n\nnamespace winslow::gui {\n\n"
       "std::span<const ShaderSource> embedded_shaders() {\n"
       "  static constexpr ShaderSource table[] = {\n${table}  };\n  return table;\n}\n\n"
       "}  // namespace winslow::gui\n")
  return()
endif()

set(WINSLOW_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(winslow_embed_shaders target)
  file(GLOB shaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/*.vert
       ${PROJECT_SOURCE_DIR}/shaders/*.geom ${PROJECT_SOURCE_DIR}/shaders/*.frag)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DINPUTS=${shaders}" -DOUTPUT=${output} -P ${WINSLOW_EMBED_SCRIPT}
    DEPENDS ${shaders} ${WINSLOW_EMBED_SCRIPT}
    COMMENT "Embedding shaders"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
