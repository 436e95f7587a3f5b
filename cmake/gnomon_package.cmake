# What `cmake --install` puts where, and the Debian package of it (scripts/package). Manual pages and completions are
# printed by the program itself, from the table that also prints --help.
include(GNUInstallDirs)
install(TARGETS gnomon RUNTIME)
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/data/desktop/gnomon.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/data/desktop/gnomon.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/data/desktop/gnomon.svg
    DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon RENAME copyright)
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/data/desktop/changelog DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon)
install(SCRIPT ${CMAKE_CURRENT_SOURCE_DIR}/cmake/install_manual.cmake)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnomon)
set(CPACK_PACKAGE_VENDOR Gnomon)
set(CPACK_PACKAGE_CONTACT "The Gnomon authors <authors@gnomon.example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "shadow maps of low error for meshes of a billion triangles")
set(CPACK_PACKAGE_DESCRIPTION
"Gnomon builds a level-of-detail model of a mesh of a million to a billion
triangles on disk, in bounded memory, walks through it with warped and
partitioned or exact shadows, and says what each bit of accuracy cost.
It reads PLY, glTF, OBJ, STL and OFF, and needs no GPU.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The program opens these while it runs, where OpenGL is asked for; its own rasteriser needs none of them.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libosmesa6, libegl1, libgl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
