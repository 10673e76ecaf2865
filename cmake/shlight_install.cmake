# What `cmake --install` puts where, so that find_package(shlight COMPONENTS …) works from there. One export set a
# folder: who takes only one component needs only that one's third-party libraries.

include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/shlight)

get_property(SHLIGHT_MODULES GLOBAL PROPERTY SHLIGHT_MODULES)
foreach(name IN LISTS SHLIGHT_MODULES)
  install(TARGETS shlight_${name} EXPORT shlight_${name})
  install(EXPORT shlight_${name} NAMESPACE shlight:: FILE shlight_${name}.cmake DESTINATION ${package_folder})

  # Which folders each folder uses, as its CMakeLists.txt has it, for the package's config.
  get_target_property(uses shlight_${name} INTERFACE_LINK_LIBRARIES)
  list(FILTER uses INCLUDE REGEX "^shlight::")
  list(TRANSFORM uses REPLACE "^shlight::" "")
  list(JOIN uses " " uses)
  string(APPEND SHLIGHT_USES "set(shlight_${name}_uses ${uses})\n")
endforeach()

configure_package_config_file(cmake/shlightConfig.cmake.in shlightConfig.cmake INSTALL_DESTINATION ${package_folder})
# Before 1.0, a change of the minor version may break what the last one promised.
write_basic_package_version_file(shlightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/shlightConfig.cmake ${PROJECT_BINARY_DIR}/shlightConfigVersion.cmake
        DESTINATION ${package_folder})

if(TARGET shlight)
  install(TARGETS shlight)
endif()
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs)
