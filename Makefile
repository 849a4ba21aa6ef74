# The C and C++ libraries: make, make install PREFIX=/usr/local [DESTDIR=...]. Linux; needs cargo and binutils.

PREFIX     ?= /usr/local
LIBDIR     ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
DESTDIR    ?=
CARGO      ?= cargo
FEATURES   ?=
OUT        ?= target/release

VERSION := $(shell sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)
MAJOR   := $(word 1,$(subst ., ,$(VERSION)))
MINOR   := $(word 2,$(subst ., ,$(VERSION)))
# What programs that are linked with one version rely on.
INTERFACE := $(if $(filter 0,$(MAJOR)),0.$(MINOR),$(MAJOR))
PRIVATE_LIBS := -lgcc_s -lutil -lrt -lpthread -lm -ldl

# From lib/cmake/fairmesh to the headers.
INCLUDEDIR_FROM_CMAKE := $(shell realpath -m --relative-to='$(LIBDIR)/cmake/fairmesh' '$(INCLUDEDIR)')

FILL = sed -e 's|@PREFIX@|$(PREFIX)|g' -e 's|@LIBDIR@|$(LIBDIR)|g' -e 's|@INCLUDEDIR@|$(INCLUDEDIR)|g' \
	-e 's|@INCLUDEDIR_FROM_CMAKE@|$(INCLUDEDIR_FROM_CMAKE)|g' -e 's|@VERSION@|$(VERSION)|g' \
	-e 's|@MAJOR@|$(MAJOR)|g' -e 's|@MINOR@|$(MINOR)|g' -e 's|@INTERFACE@|$(INTERFACE)|g'

.PHONY: all install uninstall

# Full debug information of this crate, for abidiff; what is installed is stripped.
all:
	$(CARGO) build --release --locked -p fairmesh-capi --features '$(FEATURES)' \
		--config 'profile.release.package.fairmesh-capi.debug=2'

# One object of all members, whose only global symbols are those of the header: two Rust libraries in one program do
# not meet.
install: all
	install -d '$(DESTDIR)$(LIBDIR)/pkgconfig' '$(DESTDIR)$(LIBDIR)/cmake/fairmesh' '$(DESTDIR)$(INCLUDEDIR)'
	install -m 644 include/fairmesh.h include/fairmesh.hpp include/fairmesh_openmesh.hpp \
		include/fairmesh_openmesh_fill.hpp include/fairmesh_openmesh_bridge.hpp include/fairmesh_openmesh_rim.hpp '$(DESTDIR)$(INCLUDEDIR)'
	install -m 755 $(OUT)/libfairmesh.so '$(DESTDIR)$(LIBDIR)/libfairmesh.so.$(VERSION)'
	objcopy --strip-debug '$(DESTDIR)$(LIBDIR)/libfairmesh.so.$(VERSION)'
	ln -sf libfairmesh.so.$(VERSION) '$(DESTDIR)$(LIBDIR)/libfairmesh.so.$(INTERFACE)'
	ln -sf libfairmesh.so.$(INTERFACE) '$(DESTDIR)$(LIBDIR)/libfairmesh.so'
	ld -r -o $(OUT)/fairmesh-all.o --whole-archive $(OUT)/libfairmesh.a
	objcopy --strip-debug --remove-section=.llvmbc --remove-section=.llvmcmd \
		--wildcard --keep-global-symbol='fairmesh_*' $(OUT)/fairmesh-all.o
	rm -f '$(DESTDIR)$(LIBDIR)/libfairmesh.a'
	ar rcs '$(DESTDIR)$(LIBDIR)/libfairmesh.a' $(OUT)/fairmesh-all.o
	rm $(OUT)/fairmesh-all.o
	$(FILL) -e 's|@PRIVATE_LIBS@|$(PRIVATE_LIBS)|g' packaging/fairmesh.pc.in > '$(DESTDIR)$(LIBDIR)/pkgconfig/fairmesh.pc'
	$(FILL) -e 's|@PRIVATE_LIBS@|$(subst -l,,$(subst $() -l,;,$(PRIVATE_LIBS)))|g' packaging/fairmesh-config.cmake.in \
		> '$(DESTDIR)$(LIBDIR)/cmake/fairmesh/fairmesh-config.cmake'
	$(FILL) packaging/fairmesh-config-version.cmake.in \
		> '$(DESTDIR)$(LIBDIR)/cmake/fairmesh/fairmesh-config-version.cmake'
	install -d '$(DESTDIR)$(PREFIX)/share/fairmesh/valgrind'
	install -m 644 packaging/fairmesh.supp '$(DESTDIR)$(PREFIX)/share/fairmesh/valgrind'
	@printf 'libfairmesh.so.%s needs glibc %s or newer\n' '$(VERSION)' \
		"$$(objdump -T '$(DESTDIR)$(LIBDIR)/libfairmesh.so.$(VERSION)' | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -1 | cut -d_ -f2)"

uninstall:
	rm -rf '$(DESTDIR)$(PREFIX)/share/fairmesh'
	rm -f '$(DESTDIR)$(INCLUDEDIR)'/fairmesh.h '$(DESTDIR)$(INCLUDEDIR)'/fairmesh.hpp '$(DESTDIR)$(INCLUDEDIR)'/fairmesh_openmesh.hpp \
		'$(DESTDIR)$(INCLUDEDIR)'/fairmesh_openmesh_fill.hpp '$(DESTDIR)$(INCLUDEDIR)'/fairmesh_openmesh_bridge.hpp \
		'$(DESTDIR)$(INCLUDEDIR)'/fairmesh_openmesh_rim.hpp
	rm -f '$(DESTDIR)$(LIBDIR)'/libfairmesh.a '$(DESTDIR)$(LIBDIR)'/libfairmesh.so*
	rm -f '$(DESTDIR)$(LIBDIR)'/pkgconfig/fairmesh.pc
	rm -rf '$(DESTDIR)$(LIBDIR)'/cmake/fairmesh
