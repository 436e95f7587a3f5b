# What `cmake --install` puts where, and the Debian packages of it (scripts/package): the program, the shared library,
# what compiles against it, and the Python module. Manual pages and completions are printed by the program itself, from
# the table that also prints --help.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(source ${CMAKE_CURRENT_SOURCE_DIR})
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)

# Each package says whose it is and what changed.
function(gnomon_document component package)
    install(FILES ${source}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME copyright
        COMPONENT ${component})
    install(FILES ${source}/data/desktop/changelog DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
        COMPONENT ${component})
    install(CODE "execute_process(COMMAND gzip -9nf
        \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/doc/${package}/changelog
        COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component})
endfunction()

install(TARGETS gnomon RUNTIME)
install(FILES ${source}/data/desktop/gnomon.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${source}/data/desktop/gnomon.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
install(FILES ${source}/data/desktop/gnomon.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(CODE "set(manual_of gnomon)")
install(SCRIPT ${source}/cmake/install_manual.cmake)
gnomon_document(program gnomon)
# In no package, since a job wants the MPI of its cluster: `cmake --install BUILD --component mpi`.
if(TARGET gnomon-mpi)
    install(TARGETS gnomon-mpi RUNTIME COMPONENT mpi)
    install(CODE "set(manual_of gnomon-mpi)" COMPONENT mpi)
    install(SCRIPT ${source}/cmake/install_manual.cmake COMPONENT mpi)
endif()

set(config ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)
install(TARGETS gnomon_library gnomon_part_hierarchy gnomon_part_selection gnomon_part_shadow gnomon_part_build
    EXPORT gnomon LIBRARY COMPONENT library NAMELINK_COMPONENT development
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${source}/src/api/gnomon.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon COMPONENT development)
install(EXPORT gnomon FILE gnomonConfig.cmake NAMESPACE gnomon:: DESTINATION ${config} COMPONENT development)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake DESTINATION ${config} COMPONENT development)
gnomon_document(library libgnomon0)
gnomon_document(development libgnomon-dev)

set(packaged program library development)
if(TARGET gnomon_python)
    set(module ${CMAKE_INSTALL_PREFIX}/lib/python3/dist-packages/gnomon)
    cmake_path(RELATIVE_PATH module BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX})
    install(TARGETS gnomon_python LIBRARY DESTINATION ${module} COMPONENT python)
    install(FILES ${source}/python/gnomon/__init__.py ${source}/python/gnomon/__init__.pyi
        ${source}/python/gnomon/py.typed DESTINATION ${module} COMPONENT python)
    gnomon_document(python python3-gnomon)
    list(APPEND packaged python)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnomon)
set(CPACK_PACKAGE_VENDOR Gnomon)
set(CPACK_PACKAGE_CONTACT "The Gnomon authors <authors@gnomon.example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "shadow maps of low error for meshes of a billion triangles")
set(about
"Gnomon builds a level-of-detail model of a mesh of a million to a billion
triangles on disk, in bounded memory, walks through it with warped and
partitioned or exact shadows, and says what each bit of accuracy cost.
It reads PLY, glTF, OBJ, STL and OFF, and needs no GPU.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${packaged})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src/api)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gnomon)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION ${about})
# The program opens these while it runs, where OpenGL is asked for; its own rasteriser needs none of them.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libosmesa6, libegl1, libgl1, libgl1-mesa-dri")

set(same "(= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libgnomon0)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${source}/data/desktop/library/triggers)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "level-of-detail models of large meshes, the library\n${about}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgnomon-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libgnomon0 ${same}")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "level-of-detail models of large meshes, to compile with\n${about}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-gnomon)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "libgnomon0 ${same}, ${GNOMON_PYTHON}, python3-numpy")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "level-of-detail models of large meshes, from Python\n${about}")
include(CPack)
