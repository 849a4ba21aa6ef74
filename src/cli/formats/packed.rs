//! Files packed by gzip: told by their names, as `mesh.ply.gz`.

use std::io::{self, Read, Write};
use std::path::Path;

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;

use super::pipes::is_piped;
use crate::failure::Failure;
use crate::similar::similar_file;

/// The first bytes of whatever gzip has packed.
const MARK: &[u8] = b"\x1f\x8b";

/// Whether a file of this name is packed.
pub fn is_named_so(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gz"))
}

/// The name that a file has when it is unpacked.
pub fn inner_name(path: &Path) -> &Path {
    match (is_named_so(path), path.file_stem()) {
        (true, Some(stem)) => Path::new(stem),
        _ => path,
    }
}

/// The bytes of a mesh: of a file, unpacked if its name says so, or of stdin, unpacked if they are packed.
pub fn read_mesh(path: &Path) -> Result<Vec<u8>, Failure> {
    if !is_piped(path) {
        return read(path);
    }
    let mut bytes = Vec::new();
    let read = io::stdin().lock().read_to_end(&mut bytes);
    read.map_err(|why| Failure::new(format!("-: cannot read standard input: {why}")))?;
    match bytes.starts_with(MARK) {
        true => unpacked("-", &bytes),
        false => Ok(bytes),
    }
}

/// The bytes of a file, unpacked if its name says so.
pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let name = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|why| {
        let meant = match why.kind() {
            io::ErrorKind::NotFound => similar_file(path),
            _ => None,
        };
        let meant = meant.map_or(String::new(), |meant| {
            format!("; did you mean '{}'?", meant.display())
        });
        Failure::new(format!("{name}: cannot read: {why}{meant}"))
    })?;
    match (is_named_so(path), bytes.starts_with(MARK)) {
        (false, _) => Ok(bytes),
        (true, true) => unpacked(&name, &bytes),
        (true, false) => Err(Failure::new(format!(
            "{name}: this is not compressed by gzip, as its name says; take .gz from the name"
        ))),
    }
}

fn unpacked(name: &str, bytes: &[u8]) -> Result<Vec<u8>, Failure> {
    let mut inner = Vec::new();
    // Several parts, one behind the other, are one file, as for gzip itself.
    match MultiGzDecoder::new(bytes).read_to_end(&mut inner) {
        Ok(_) => Ok(inner),
        Err(why) => {
            let why = match why.kind() {
                io::ErrorKind::UnexpectedEof => "it is cut off".to_owned(),
                _ => why.to_string(),
            };
            Err(Failure::new(format!("{name}: cannot be unpacked: {why}")))
        }
    }
}

/// The same bytes, packed; without a time or a name, so that equal meshes are equal files.
pub fn packed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// What the bytes are packed in, against what their name says.
pub fn packing(bytes: &[u8]) -> Option<&'static str> {
    let packings: [(&[u8], _); 5] = [
        (
            b"\x1f\x8b",
            "this file is compressed (gzip); unpack it first, or let its name end in .gz",
        ),
        (b"PK\x03\x04", "this file is compressed (zip); unpack it first"),
        (b"\xfd7zXZ\0", "this file is compressed (xz); unpack it first"),
        (b"\xff\xfe", "this text is encoded as UTF-16; save it as UTF-8"),
        (b"\xfe\xff", "this text is encoded as UTF-16; save it as UTF-8"),
    ];
    let found = packings.iter().find(|(mark, _)| bytes.starts_with(mark));
    found.map(|(_, why)| *why)
}
