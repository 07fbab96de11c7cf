# sward_settings(TARGET): warnings, language level, floating-point rules, sanitizers.

# The CPU twin must round as the shaders do: no fused multiply-add.
function(sward_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    -Wnon-virtual-dtor -ffp-contract=off)
  # No path of the build machine in what assertions say.
  target_compile_options(${target} PRIVATE "-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=")
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # g++ 12 sees overlaps and overflows in strings that are not there (its bug 105651 and others).
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow)
  endif()
  if(SWARD_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(SWARD_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${SWARD_SANITIZE} -fno-omit-frame-pointer -g)
    if(SWARD_SANITIZE MATCHES "undefined")
      target_compile_options(${target} PUBLIC -fno-sanitize-recover=undefined)
    endif()
    target_link_options(${target} PUBLIC -fsanitize=${SWARD_SANITIZE})
  endif()
endfunction()

# sward_precompiled(NAME HEADER LIBRARIES...): a target whose precompiled HEADER others take by sward_precompile(). Most of
# what a file takes to compile is headers that all files share. A convenience of the build: every file includes what it
# names, and -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds as well.
function(sward_precompiled name header)
  file(GENERATE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp" CONTENT "\n")
  add_library(${name} OBJECT "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
  target_precompile_headers(${name} PRIVATE "${header}")
  target_link_libraries(${name} PRIVATE ${ARGN})
  sward_settings(${name})
endfunction()

# sward_precompile(TARGET NAME): TARGET is compiled with the very options of NAME.
function(sward_precompile target name)
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()

# sward_library(NAME [USES sward's libraries] [PUBLIC ...] [PRIVATE ...] [INCLUDES folders]):
# compiles src/NAME/*.cpp once, into the object library sward_NAME_objects, and makes of it
#   sward_NAME         static; what tests and the tool link, for they look at what is hidden
#   sward_NAME_shared  libsward-NAME.so, where SWARD_SHARED is on; exports what SWARD_API marks
# In the tree sward::NAME is the static one; below another project it is the shared one where BUILD_SHARED_LIBS is on.
# It links USES (names of sward's own libraries), PUBLIC and PRIVATE (anybody's); INCLUDES are private folders of headers.
function(sward_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES;PUBLIC;PRIVATE;INCLUDES")
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/src/${name}/*.cpp")
  add_library(sward_${name}_objects OBJECT ${sources})
  target_include_directories(sward_${name}_objects PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/src" ${arg_INCLUDES})
  target_include_directories(sward_${name}_objects PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/include")
  list(TRANSFORM arg_USES PREPEND sward_ OUTPUT_VARIABLE used_targets)
  target_link_libraries(sward_${name}_objects PRIVATE ${used_targets} ${arg_PUBLIC} ${arg_PRIVATE})
  # Only what SWARD_API marks is seen from outside.
  set_target_properties(sward_${name}_objects PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  sward_settings(sward_${name}_objects)
  sward_precompile(sward_${name}_objects sward_library_headers)

  add_library(sward_${name} STATIC)
  set_target_properties(sward_${name} PROPERTIES OUTPUT_NAME sward-${name} EXPORT_NAME ${name}_static)
  sward_kind_of_library(sward_${name} "")
  if(SWARD_SHARED)
    add_library(sward_${name}_shared SHARED)
    set_target_properties(sward_${name}_shared PROPERTIES OUTPUT_NAME sward-${name} EXPORT_NAME ${name}
      VERSION ${PROJECT_VERSION} SOVERSION ${SWARD_SOVERSION} INSTALL_RPATH "$ORIGIN")
    target_link_options(sward_${name}_shared PRIVATE -Wl,--no-undefined -Wl,--as-needed
      "-Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map")
    set_target_properties(sward_${name}_shared PROPERTIES LINK_DEPENDS "${PROJECT_SOURCE_DIR}/cmake/exports.map")
    sward_kind_of_library(sward_${name}_shared "_shared")
  endif()
  if(BUILD_SHARED_LIBS AND NOT PROJECT_IS_TOP_LEVEL)
    add_library(sward::${name} ALIAS sward_${name}_shared)
  else()
    add_library(sward::${name} ALIAS sward_${name})
  endif()
endfunction()

# What the static and the shared library have in common. Reads the arguments of sward_library.
macro(sward_kind_of_library target suffix)
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:sward_${name}_objects>)
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  foreach(used IN LISTS arg_USES)
    target_link_libraries(${target} PUBLIC sward_${used}${suffix})
  endforeach()
  sward_settings(${target})
endmacro()
