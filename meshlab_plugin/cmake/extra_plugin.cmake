# SPDX-License-Identifier: MIT OR Apache-2.0
# The plugin as a part of MeshLab's own build, which knows its version, its numbers, Qt and where plugins go.
# The library is the ready-made one of this system; on Windows, whose static one is for GCC, the DLL, which goes beside the program.
find_package(fairmesh 0.1 REQUIRED)
add_meshlab_plugin(filter_fairmesh ${FILTERS} src/plugin_2022.cpp src/plugin_2022.h)
target_compile_features(filter_fairmesh PRIVATE cxx_std_17)
set_target_properties(filter_fairmesh PROPERTIES AUTOMOC ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
if(WIN32)
    target_link_libraries(filter_fairmesh PRIVATE fairmesh::fairmesh)
    install(FILES $<TARGET_FILE:fairmesh::fairmesh> DESTINATION . COMPONENT Plugins)
else()
    target_link_libraries(filter_fairmesh PRIVATE fairmesh::static)
endif()
