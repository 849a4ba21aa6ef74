# SPDX-License-Identifier: MIT OR Apache-2.0
# The programs that the plugin is built and tested for: the only place where their versions stand. Sourced by build.sh and test.sh.

# host NAME sets:
#   tarball    MeshLab's sources (with vcglib), as Debian keeps them, for the headers
#   sha256     of the tarball: its sources are fetched over any channel and checked
#   sha1       the same file at snapshot.debian.org, which keeps everything
#   pypi       the PyPI release, for PyMeshLab
#   release    the program's version, where the tarball is of another one whose types are the same
#   label      in the name of what is published
host() {
    pypi="" release=""
    case "$1" in
    debian) # Debian 11 and 12, Ubuntu 22.04: MeshLab 2020.09, float
        tarball=meshlab_2020.09+dfsg1.orig.tar.xz
        sha256=d6715352ff65caffdec0292858d4263eb0c3cbbf3b1e5c2e2bab218e3f234630
        sha1=bd2a1de2a96991f9e4b8ddc7781287ba3413cc6d
        label=meshlab-2020.09
        ;;
    pymeshlab) # the newest: 2025.07, double
        tarball=meshlab_2025.07~dfsg.orig.tar.xz
        sha256=d22c98d362f2a284e481af8dbfc272b2222f5b9c67b3cf8bec57d1c3161886f4
        sha1=67de59f12b5a170973eec5f5e83d346d25c84662
        pypi=pymeshlab==2025.7.post1
        label=pymeshlab-2025.7
        ;;
    pymeshlab-2022) # the oldest with the new plugin interface: 2022.02, double
        tarball=meshlab_2022.02+dfsg1.orig.tar.xz
        sha256=11da26ec46c3fbbbc806d410a3221542ec21ec13fdcc55d624304600029435fd
        sha1=92c2b1070f80f5cf1d575ac81dec721bd930e2dd
        pypi=pymeshlab==2022.2.post4
        label=pymeshlab-2022.2
        ;;
    pymeshlab-2023)
        # 2023.12, double. Debian has no sources of it. Those of 2025.07 have the same types: of src/common three headers differ, in two
        # addresses of pages, a name for Python, and an argument of a function that is not used here; of vcglib algorithms alone do.
        host pymeshlab
        pypi=pymeshlab==2023.12.post3
        release=2023.12
        label=pymeshlab-2023.12
        ;;
    *) return 1 ;;
    esac
}

HOSTS="debian pymeshlab pymeshlab-2022 pymeshlab-2023"
