# sward_library(NAME): a library target sward_NAME, alias sward::NAME, from src/NAME/*.cpp, with the project's settings.
# sward_settings(TARGET): warnings, language level, floating-point rules, sanitizers.

# The CPU twin must round as the shaders do: no fused multiply-add.
function(sward_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    -Wnon-virtual-dtor -ffp-contract=off)
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

function(sward_library name)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/src/${name}/*.cpp")
  add_library(sward_${name} ${sources})
  add_library(sward::${name} ALIAS sward_${name})
  # Only what SWARD_API marks is seen from outside.
  set_target_properties(sward_${name} PROPERTIES EXPORT_NAME ${name} CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(sward_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  sward_settings(sward_${name})
endfunction()
