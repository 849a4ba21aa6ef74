//! Files that are written whole or not at all.

use std::fs::{self, Permissions};
use std::io::Write;
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use crate::failure::Failure;

/// Where a file will be written.
pub struct Output {
    /// The name the user gave, for messages.
    name: String,
    /// The file itself, behind links.
    target: PathBuf,
    /// A pipe or device, which cannot be replaced.
    is_special: bool,
}

impl Output {
    /// Finds out whether the file can be written, before any work is done.
    pub fn prepare(path: &Path) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let mut output = Self {
            name,
            target,
            is_special: false,
        };
        match fs::metadata(&output.target) {
            Ok(found) if found.is_dir() => {
                return Err(output.failure("this is a directory; name a file in it"));
            }
            Ok(found) if !found.is_file() => output.is_special = true,
            Ok(found) if found.permissions().readonly() => {
                return Err(output.failure("the file is write-protected; choose another name"));
            }
            _ => drop(output.temporary()?),
        }
        Ok(output)
    }

    fn failure(&self, why: impl std::fmt::Display) -> Failure {
        Failure::new(format!("{}: cannot write: {why}", self.name))
    }

    /// A new file beside the target, so that renaming it cannot cross file systems.
    fn temporary(&self) -> Result<NamedTempFile, Failure> {
        let directory = match self.target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let mut builder = Builder::new();
        builder.prefix(".fairmesh-");
        let permissions = fs::metadata(&self.target)
            .ok()
            .map(|found| found.permissions())
            .or_else(usual_permissions);
        if let Some(permissions) = permissions.clone() {
            builder.permissions(permissions);
        }
        let file = builder.tempfile_in(directory).map_err(|why| {
            let directory = directory.display();
            self.failure(format!("no file can be made in '{directory}': {}", short(&why)))
        })?;
        Ok(file)
    }

    /// Writes the bytes to a temporary file and gives it the name.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        if self.is_special {
            return fs::write(&self.target, bytes).map_err(|why| self.failure(why));
        }
        let permissions = fs::metadata(&self.target).ok().map(|found| found.permissions());
        let mut file = self.temporary()?;
        file.write_all(bytes)
            .and_then(|()| file.as_file().sync_all())
            .map_err(|why| self.failure(why))?;
        if let Some(permissions) = permissions {
            // Making a file applies the umask; an existing file's permissions are kept exactly.
            file.as_file()
                .set_permissions(permissions)
                .map_err(|why| self.failure(why))?;
        }
        file.persist(&self.target)
            .map_err(|why| self.failure(why.error))?;
        Ok(())
    }
}

/// The system's reason without the path, which tempfile adds.
fn short(why: &std::io::Error) -> String {
    match why.kind() {
        std::io::ErrorKind::NotFound => "it does not exist".to_owned(),
        kind => kind.to_string(),
    }
}

/// What a newly made file has, before the umask.
#[cfg(unix)]
fn usual_permissions() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

/// What a newly made file has: nothing to say.
#[cfg(not(unix))]
fn usual_permissions() -> Option<Permissions> {
    None
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn files_are_replaced_whole_with_their_permissions() {
        let directory = tempfile::tempdir().unwrap();
        let (file, link) = (directory.path().join("file"), directory.path().join("link"));
        Output::prepare(&file).unwrap().write(b"one").unwrap();
        // Others may read a new file if the umask lets them, unlike a temporary one.
        fs::write(directory.path().join("usual"), "").unwrap();
        assert_eq!(mode(&file), mode(&directory.path().join("usual")));
        fs::set_permissions(&file, Permissions::from_mode(0o666)).unwrap();
        symlink("file", &link).unwrap();
        Output::prepare(&link).unwrap().write(b"two").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"two");
        assert_eq!(mode(&file), 0o666);
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 3);
    }

    #[test]
    fn what_cannot_be_written_is_refused_before_the_work() {
        let directory = tempfile::tempdir().unwrap();
        let refused = |path: &Path| Output::prepare(path).err().unwrap().to_string();
        assert!(refused(directory.path()).ends_with("cannot write: this is a directory; name a file in it"));
        let file = directory.path().join("file");
        fs::write(&file, "precious").unwrap();
        fs::set_permissions(&file, Permissions::from_mode(0o444)).unwrap();
        assert!(refused(&file).ends_with("the file is write-protected; choose another name"));
        assert!(refused(&directory.path().join("none/file")).ends_with("it does not exist"));
        Output::prepare(Path::new("/dev/null"))
            .unwrap()
            .write(b"gone")
            .unwrap();
    }
}
