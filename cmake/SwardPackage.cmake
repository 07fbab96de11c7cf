# Debian packages by CPack; cmake/package.sh makes them. The parts are those of SwardInstall.cmake.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sward)
set(CPACK_PACKAGE_VENDOR "the sward authors")
set(CPACK_PACKAGE_CONTACT "the sward authors <sward@localhost>")
set(CPACK_PACKAGE_FILE_NAME "sward-${PROJECT_VERSION}")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "ROAM terrain covered with vegetation that the GPU grows")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
# What CMake, pkg-config and the dynamic linker find without being told.
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL tool runtime development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
# Sward's own libraries belong to no package yet while the packages are made; their dependencies are named below.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/terrain" "${PROJECT_BINARY_DIR}/vegetation")

set(version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
set(library_package libsward${SWARD_SOVERSION})

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "Shared libraries: ROAM terrain under a triangle budget, and plants that the \
GPU seeds by the colour of the ground and grows blade by blade, with OpenGL 4.5.")

set(CPACK_DEBIAN_TOOL_PACKAGE_NAME sward)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOL_PACKAGE_DEPENDS "${library_package} (= ${version})")
set(CPACK_DEBIAN_TOOL_DESCRIPTION "Viewer and scenes: flies over terrain, renders pictures and films of it, \
measures and bakes it; with shaders, documentation, and the libraries that read files of images and meshes.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsward-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} (= ${version}), libglm-dev, libexpected-dev, \
libepoxy-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_GENERATE_SHLIBS OFF)
# The shared image_io and mesh_source are in sward; their static ones link what the other two hold.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "sward (= ${version}), pkg-config")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "libopenimageio-dev, libopenmesh-dev, libglfw3-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "What is needed to build programs with sward: headers, static libraries, a \
CMake package, pkg-config files and the smallest hosts as examples.")

# Each package says its licence where Debian looks for it.
foreach(part IN ITEMS RUNTIME TOOL DEVELOPMENT)
  string(TOLOWER ${part} component)
  install(FILES LICENSE RENAME copyright COMPONENT ${component}
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${part}_PACKAGE_NAME}")
endforeach()

include(CPack)
