# sward_embed(TARGET OUTPUT_NAME HEADER SYMBOL FILES...): compiles text files into TARGET, so that no source path is needed
# at run time. The generated unit includes HEADER and defines SYMBOL() (namespaces included), a span of
# sward::EmbeddedText.

function(sward_embed target output_name header symbol)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/${output_name}.cpp")
  add_custom_command(OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DHEADER=${header}" "-DSYMBOL=${symbol}" "-DSOURCES=${ARGN}"
      -P "${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake"
    DEPENDS ${ARGN} "${PROJECT_SOURCE_DIR}/cmake/EmbedText.cmake"
    COMMENT "Embedding ${output_name}" VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()

function(sward_embed_shaders target directory)
  file(GLOB sources CONFIGURE_DEPENDS "${directory}/*.glsl")
  sward_embed(${target} embedded_shaders sward/gl/shader_library.h sward::gl::embedded_shaders ${sources})
endfunction()

function(sward_embed_scenes target directory)
  file(GLOB sources CONFIGURE_DEPENDS "${directory}/*.toml")
  sward_embed(${target} embedded_scenes sward/scene/scene.h sward::embedded_scenes ${sources})
endfunction()
