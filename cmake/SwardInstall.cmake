# What `cmake --install` puts where. Three parts (--component), which are also the Debian packages:
#   runtime      libsward-terrain, -gl, -terrain_gl, -vegetation, -scene: shared libraries that need GLM and libepoxy only
#   tool         the tool, scenes, kinds, shaders, documentation, and the shared libraries that need more (image_io,
#                mesh_source)
#   development  headers, static libraries, CMake package, pkg-config files
# The CMake package has a component for each set of libraries, and the component `static` for the static ones.
include(CMakePackageConfigHelpers)

set(sward_cmake_dir "${CMAKE_INSTALL_LIBDIR}/cmake/sward")
set(sward_pc_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
cmake_path(SET prefix_from_pc "${CMAKE_INSTALL_PREFIX}")
cmake_path(RELATIVE_PATH prefix_from_pc BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}/${sward_pc_dir}")

# sward_install_library(NAME SET set RUNTIME component DESCRIPTION text FOLDER of its headers [REQUIRES packages]
# [REQUIRES_PRIVATE packages] [LIBS_PRIVATE flags]): the last three are those of its pkg-config file.
function(sward_install_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SET;RUNTIME;DESCRIPTION;FOLDER" "REQUIRES;REQUIRES_PRIVATE;LIBS_PRIVATE")
  install(TARGETS sward_${name} EXPORT sward-${arg_SET}-static ARCHIVE COMPONENT development)
  if(SWARD_SHARED)
    install(TARGETS sward_${name}_shared EXPORT sward-${arg_SET}-shared LIBRARY COMPONENT ${arg_RUNTIME}
      NAMELINK_COMPONENT development)
  endif()
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${arg_FOLDER}/include/sward/${name}" COMPONENT development
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/sward" FILES_MATCHING PATTERN "*.h")
  set(description "${arg_DESCRIPTION}")
  list(JOIN arg_REQUIRES " " requires)
  list(JOIN arg_REQUIRES_PRIVATE " " requires_private)
  list(JOIN arg_LIBS_PRIVATE " " libs_private)
  configure_file("${PROJECT_SOURCE_DIR}/cmake/sward.pc.in" "${PROJECT_BINARY_DIR}/pkgconfig/sward-${name}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/pkgconfig/sward-${name}.pc" DESTINATION "${sward_pc_dir}"
    COMPONENT development)
endfunction()

# The targets' files of a set of libraries. CMake's own names end in an asterisk: none may be the beginning of another.
function(sward_install_set set)
  install(EXPORT sward-${set}-static NAMESPACE sward:: DESTINATION "${sward_cmake_dir}" COMPONENT development)
  if(SWARD_SHARED)
    install(EXPORT sward-${set}-shared NAMESPACE sward:: DESTINATION "${sward_cmake_dir}" COMPONENT development)
  endif()
endfunction()

sward_install_library(terrain SET terrain FOLDER terrain RUNTIME runtime REQUIRES glm LIBS_PRIVATE -pthread
  DESCRIPTION "ROAM terrain: height fields, bounds, meshes, queries")
sward_install_set(terrain)
sward_install_library(gl SET vegetation FOLDER terrain RUNTIME runtime REQUIRES sward-terrain epoxy
  LIBS_PRIVATE -ldl DESCRIPTION "What sward's OpenGL libraries share")
sward_install_library(terrain_gl SET vegetation FOLDER terrain RUNTIME runtime REQUIRES sward-gl
  DESCRIPTION "Drawing ROAM terrain with OpenGL 4.5")
sward_install_library(vegetation SET vegetation FOLDER vegetation RUNTIME runtime REQUIRES sward-terrain_gl
  DESCRIPTION "Vegetation seeded on terrain and grown on the GPU")
sward_install_set(vegetation)
if(SWARD_SCENE)
  sward_install_library(scene SET scene FOLDER vegetation RUNTIME runtime REQUIRES sward-vegetation
    LIBS_PRIVATE -pthread DESCRIPTION "Terrain, layers and species from TOML files")
  sward_install_set(scene)
endif()
if(SWARD_IMAGE_IO)
  sward_install_library(image_io SET image_io FOLDER terrain RUNTIME tool REQUIRES sward-terrain
    REQUIRES_PRIVATE OpenImageIO DESCRIPTION "Height maps, colour maps and pictures through OpenImageIO")
  sward_install_set(image_io)
endif()
if(SWARD_MESH_SOURCE)
  sward_install_library(mesh_source SET mesh_source FOLDER vegetation RUNTIME tool REQUIRES sward-vegetation
    LIBS_PRIVATE -lOpenMeshCore DESCRIPTION "Static meshes from files through OpenMesh")
  sward_install_set(mesh_source)
endif()

install(FILES terrain/include/sward/api.h terrain/include/sward/version.h COMPONENT development
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/sward")
configure_package_config_file(cmake/sward-config.cmake.in "${PROJECT_BINARY_DIR}/sward-config.cmake"
  INSTALL_DESTINATION "${sward_cmake_dir}")
# Before 1.0 a minor version may break hosts.
set(compatibility SameMajorVersion)
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(compatibility SameMinorVersion)
endif()
write_basic_package_version_file("${PROJECT_BINARY_DIR}/sward-config-version.cmake" COMPATIBILITY ${compatibility})
install(FILES "${PROJECT_BINARY_DIR}/sward-config.cmake" "${PROJECT_BINARY_DIR}/sward-config-version.cmake"
  DESTINATION "${sward_cmake_dir}" COMPONENT development)

# For hosts' kinds of plants (`#include` in their GLSL) and for `--shaders`; the libraries hold a copy and need no files.
install(DIRECTORY shaders/ DESTINATION "${CMAKE_INSTALL_DATADIR}/sward/shaders" COMPONENT tool
  FILES_MATCHING PATTERN "*.glsl" PATTERN "README.md")
install(DIRECTORY demo/scenes demo/kinds demo/ground DESTINATION "${CMAKE_INSTALL_DATADIR}/sward" COMPONENT tool)
install(DIRECTORY docs/ DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT tool FILES_MATCHING PATTERN "*.md"
  PATTERN "pictures" EXCLUDE)
install(FILES README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT tool)
install(DIRECTORY demo/hello DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples" COMPONENT development)
if(TARGET sward)
  install(TARGETS sward RUNTIME COMPONENT tool)
endif()
