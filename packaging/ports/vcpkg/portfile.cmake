# An overlay port: it installs the library as it is published, made by Rust once for every triplet.
vcpkg_check_linkage(ONLY_DYNAMIC_LIBRARY)
set(VCPKG_BUILD_TYPE release)
set(VCPKG_POLICY_MISMATCHED_NUMBER_OF_BINARIES enabled)
# The CMake package finds the library by its own place.
set(VCPKG_POLICY_SKIP_MISPLACED_CMAKE_FILES_CHECK enabled)
set(VCPKG_POLICY_SKIP_LIB_CMAKE_MERGE_CHECK enabled)

set(linux-x64 linux-x86_64.tar.gz @SHA512:linux-x86_64.tar.gz@)
set(linux-arm64 linux-aarch64.tar.gz @SHA512:linux-aarch64.tar.gz@)
set(osx-x64 macos-x86_64.tar.gz @SHA512:macos-x86_64.tar.gz@)
set(osx-arm64 macos-aarch64.tar.gz @SHA512:macos-aarch64.tar.gz@)
set(windows-x64 windows-x86_64.zip @SHA512:windows-x86_64.zip@)
if(VCPKG_TARGET_IS_WINDOWS)
  set(system windows)
elseif(VCPKG_TARGET_IS_OSX)
  set(system osx)
else()
  set(system linux)
endif()
list(GET ${system}-${VCPKG_TARGET_ARCHITECTURE} 0 end)
list(GET ${system}-${VCPKG_TARGET_ARCHITECTURE} 1 hash)

vcpkg_download_distfile(ARCHIVE
  URLS "@URL@/fairmesh-@VERSION@-${end}"
  FILENAME "fairmesh-@VERSION@-${end}"
  SHA512 ${hash})
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${ARCHIVE}")

file(INSTALL "${SOURCE_PATH}/include" "${SOURCE_PATH}/lib" DESTINATION "${CURRENT_PACKAGES_DIR}")
file(REMOVE "${CURRENT_PACKAGES_DIR}/lib/libfairmesh.a")
if(VCPKG_TARGET_IS_WINDOWS)
  file(INSTALL "${SOURCE_PATH}/bin" DESTINATION "${CURRENT_PACKAGES_DIR}")
endif()
vcpkg_fixup_pkgconfig()
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST
  "${SOURCE_PATH}/share/doc/fairmesh/LICENSE-MIT"
  "${SOURCE_PATH}/share/doc/fairmesh/LICENSE-APACHE"
  "${SOURCE_PATH}/share/doc/fairmesh/THIRD-PARTY.txt")
