# What portfile.cmake calls, in place of vcpkg, which cannot be had from a package registry. -D PORT, PACKAGES (where it installs), PORTFILE.
cmake_minimum_required(VERSION 3.20)
set(CURRENT_PACKAGES_DIR "${PACKAGES}")
set(VCPKG_TARGET_ARCHITECTURE x64)

function(vcpkg_check_linkage)
endfunction()

function(vcpkg_download_distfile result)
  cmake_parse_arguments(ASKED "" "FILENAME;SHA512" "URLS" ${ARGN})
  file(DOWNLOAD "${ASKED_URLS}" "${PACKAGES}.downloads/${ASKED_FILENAME}" EXPECTED_HASH SHA512=${ASKED_SHA512})
  set(${result} "${PACKAGES}.downloads/${ASKED_FILENAME}" PARENT_SCOPE)
endfunction()

# Its folder is that of the only folder in the archive.
function(vcpkg_extract_source_archive result)
  cmake_parse_arguments(ASKED "" "ARCHIVE" "" ${ARGN})
  file(ARCHIVE_EXTRACT INPUT "${ASKED_ARCHIVE}" DESTINATION "${PACKAGES}.sources")
  file(GLOB folder "${PACKAGES}.sources/*")
  set(${result} "${folder}" PARENT_SCOPE)
endfunction()

function(vcpkg_fixup_pkgconfig)
endfunction()

function(vcpkg_install_copyright)
  cmake_parse_arguments(ASKED "" "" "FILE_LIST" ${ARGN})
  file(INSTALL ${ASKED_FILE_LIST} DESTINATION "${PACKAGES}/share/${PORT}")
endfunction()

include("${PORTFILE}")
