# Installs the library, its headers, the program and a package that find_package(tyndall) finds.
include(CMakePackageConfigHelpers)

install(TARGETS tyndall tyndall_options EXPORT tyndallTargets FILE_SET HEADERS)
install(TARGETS tyndall_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT tyndallTargets NAMESPACE tyndall:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tyndall)

configure_package_config_file(
  cmake/tyndallConfig.cmake.in tyndallConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tyndall)
write_basic_package_version_file(tyndallConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tyndallConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/tyndallConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tyndall)
