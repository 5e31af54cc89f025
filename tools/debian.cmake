# `cpack --config build/CPackConfig.cmake` makes Debian packages of what is installed, by component:
#   posevote          the program, libposevote, configs, pipelines, man page, completion
#   posevote-dev      headers and find_package(posevote)
#   python3-posevote  import posevote
#   posevote-pcl, posevote-opencv   nodes that pull hundreds of MB: rivals, PCL's descriptors
foreach(component runtime dev python pcl opencv)
  set(package posevote-${component})
  if(component STREQUAL runtime)
    set(package posevote)
  elseif(component STREQUAL python)
    set(package python3-posevote)
  endif()
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SHLIBDEPS ON)
  if(NOT component STREQUAL runtime)
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_DEPENDS "posevote (= ${PROJECT_VERSION})")
  endif()
  install(FILES LICENSE DESTINATION share/doc/${package} RENAME copyright COMPONENT ${component})
endforeach()
set(CPACK_COMPONENTS_ALL runtime dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "libeigen3-dev (>= ${Eigen3_VERSION})")  # for plugins
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "posevote-pcl, posevote-opencv, python3-posevote")
foreach(component pcl opencv)
  if(TARGET posevote_${component})
    list(APPEND CPACK_COMPONENTS_ALL ${component})
  endif()
endforeach()
if(TARGET posevote_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ", python3-numpy"
    ", python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next})")
endif()

set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Finds known 3D objects in 3D scans
 The program posevote and its library. From a scan (laser, structured light, RGB-D) they give the
 six-degree-of-freedom pose of every known object, in clutter and partly hidden.")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Finds known 3D objects in 3D scans - C++ headers
 posevote/recognizer.hpp, the headers of plugins, and find_package(posevote).")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Finds known 3D objects in 3D scans - Python module
 import posevote: the recognizer for NumPy arrays and files, with type stubs.")
set(CPACK_COMPONENT_PCL_DESCRIPTION "Finds known 3D objects in 3D scans - nodes of PCL
 Descriptors of the Point Cloud Library, and its recognisers as rivals to compare with.")
set(CPACK_COMPONENT_OPENCV_DESCRIPTION "Finds known 3D objects in 3D scans - nodes of OpenCV
 OpenCV's point-pair features, a rival to compare with.")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME posevote)
set(CPACK_PACKAGE_VENDOR "the posevote authors")
set(CPACK_PACKAGE_CONTACT "the posevote authors <posevote@localhost>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
# Where the other packages' dependency on libposevote is looked up; they name it themselves.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${POSEVOTE_LIBRARIES})
include(CPack)
