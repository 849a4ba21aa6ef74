"""The library as it is published, made by Rust once for every system."""

from pathlib import Path

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.files import copy, get

required_conan_version = ">=2.0"


class FairmeshConan(ConanFile):
    name = "fairmesh"
    version = "@VERSION@"
    description = "Fair surfaces on triangle meshes: fills holes, takes bumps and dents away, joins tubes"
    license = ("MIT", "Apache-2.0")
    homepage = "@REPOSITORY@"
    topics = ("mesh", "geometry", "fairing", "smoothing", "hole-filling", "pre-built")
    package_type = "library"
    # The compiler is asked for validate() alone.
    settings = ("os", "arch", "compiler", "build_type")
    options = {"shared": [True, False]}  # noqa: RUF012
    default_options = {"shared": True}  # noqa: RUF012

    def package_id(self):
        del self.info.settings.compiler
        del self.info.settings.build_type

    def validate(self):
        if str(self.settings.arch) not in self.conan_data["sources"][self.version].get(str(self.settings.os), {}):
            raise ConanInvalidConfiguration(f"there is no build for {self.settings.os} on {self.settings.arch}")
        if self.settings.compiler == "msvc" and not self.options.shared:
            raise ConanInvalidConfiguration("the static library for Windows is GCC's")

    def build(self):
        source = self.conan_data["sources"][self.version][str(self.settings.os)][str(self.settings.arch)]
        get(self, **source, strip_root=True)

    def package(self):
        here, package = self.build_folder, Path(self.package_folder)
        copy(self, "*", Path(here) / "share/doc/fairmesh", package / "licenses")
        copy(self, "*", Path(here) / "include", package / "include")
        for pattern in ["*.dll"] if self.options.shared else []:
            copy(self, pattern, Path(here) / "bin", package / "bin")
        for pattern in ["*.so*", "*.dylib", "*.lib", "*.dll.a"] if self.options.shared else ["libfairmesh.a"]:
            copy(self, pattern, Path(here) / "lib", package / "lib", keep_path=False)

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "fairmesh")
        self.cpp_info.set_property("cmake_target_name", "fairmesh::fairmesh")
        self.cpp_info.set_property("pkg_config_name", "fairmesh")
        self.cpp_info.libs = ["fairmesh"]
        if self.options.shared:
            self.cpp_info.defines = ["FAIRMESH_DLL"] if self.settings.os == "Windows" else []
            return
        self.cpp_info.system_libs = {
            "Linux": ["gcc_s", "util", "rt", "pthread", "m", "dl"],
            "Macos": ["iconv", "m"],
            "Windows": ["kernel32", "ntdll", "userenv", "ws2_32", "dbghelp"],
        }[str(self.settings.os)]
