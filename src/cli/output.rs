//! Files that are written whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::failure::{ExitCode, Failure};
use crate::formats::packed;
use crate::formats::pipes::is_piped;
use crate::temporary::Temporary;

/// Where a file will be written.
pub struct Output {
    /// The name the user gave, for messages.
    name: String,
    /// The file itself, behind links.
    target: PathBuf,
    /// A pipe or device, which cannot be replaced.
    is_special: bool,
    /// Not a file at all.
    is_stdout: bool,
}

impl Output {
    /// A file, or stdout if it is named `-`.
    pub fn prepare_or_stdout(path: &Path) -> Result<Self, Failure> {
        if !is_piped(path) {
            return Self::prepare(path);
        }
        Ok(Self {
            name: "standard output".to_owned(),
            target: path.to_path_buf(),
            is_special: true,
            is_stdout: true,
        })
    }

    /// Finds out whether the file can be written, before any work is done.
    pub fn prepare(path: &Path) -> Result<Self, Failure> {
        let mut output = Self {
            name: path.display().to_string(),
            target: path.to_path_buf(),
            is_special: false,
            is_stdout: false,
        };
        match fs::canonicalize(path) {
            Ok(target) => output.target = target,
            // As `cp` does: to replace the link, or to make what it names, may both be wrong.
            Err(_) if path.is_symlink() => {
                return Err(output.failure("this is a link to what does not exist"));
            }
            Err(_) => {}
        }
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
    fn temporary(&self) -> Result<Temporary, Failure> {
        let directory = match self.target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        Temporary::new(directory).map_err(|why| {
            if matches!(why.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::OutOfMemory) {
                return self
                    .failure("memory or threads ran out")
                    .with_code(ExitCode::Exhausted);
            }
            let directory = directory.display();
            self.failure(format!("no file can be made in '{directory}': {}", short(&why)))
        })
    }

    /// Writes the bytes to a temporary file and gives it the name; packed if the name says so.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        if self.is_stdout {
            let mut stdout = io::stdout().lock();
            let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
            return written.map_err(|why| self.failure(why));
        }
        let packed;
        let bytes = match packed::is_named_so(Path::new(&self.name)) {
            true => {
                packed = packed::packed(bytes).map_err(|why| self.failure(why))?;
                &packed
            }
            false => bytes,
        };
        if self.is_special {
            return fs::write(&self.target, bytes).map_err(|why| self.failure(why));
        }
        let temporary = self.temporary()?;
        self.replace(temporary, bytes).map_err(|why| self.failure(why))
    }

    fn replace(&self, temporary: Temporary, bytes: &[u8]) -> io::Result<()> {
        let mut file = temporary.file();
        // Before the bytes: what only some may read is at no time open to others.
        if let Ok(found) = fs::metadata(&self.target) {
            file.set_permissions(found.permissions())?;
        }
        file.write_all(bytes)?;
        file.sync_all()?;
        temporary.rename(&self.target)
    }
}

/// The system's reason in few words.
fn short(why: &io::Error) -> String {
    match why.kind() {
        io::ErrorKind::NotFound => "it does not exist".to_owned(),
        kind => kind.to_string(),
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::fs::Permissions;
    use std::os::unix::fs::{PermissionsExt, symlink};
    use std::process;

    use super::*;

    /// An empty directory, removed at the end.
    struct Scratch(PathBuf);

    impl Scratch {
        fn new(test: &str) -> Self {
            let path = std::env::temp_dir().join(format!("fairmesh-{}-{test}", process::id()));
            fs::create_dir(&path).unwrap();
            Self(path)
        }

        fn path(&self) -> &Path {
            &self.0
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            fs::remove_dir_all(&self.0).unwrap();
        }
    }

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn files_are_replaced_whole_with_their_permissions() {
        let directory = Scratch::new("permissions");
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
    fn other_files_stay_and_a_failed_write_leaves_none_behind() {
        let directory = Scratch::new("failed");
        let (file, taken) = (
            directory.path().join("file"),
            directory.path().join(format!(".fairmesh-{}-0", process::id())),
        );
        fs::write(&taken, "of another run").unwrap();
        let output = Output::prepare(&file).unwrap();
        fs::create_dir(&file).unwrap();
        output.write(b"nowhere to go").unwrap_err();
        assert_eq!(fs::read(&taken).unwrap(), b"of another run");
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 2);
    }

    #[test]
    fn what_cannot_be_written_is_refused_before_the_work() {
        let directory = Scratch::new("refused");
        let refused = |path: &Path| Output::prepare(path).err().unwrap().to_string();
        assert!(refused(directory.path()).ends_with("cannot write: this is a directory; name a file in it"));
        let file = directory.path().join("file");
        fs::write(&file, "precious").unwrap();
        fs::set_permissions(&file, Permissions::from_mode(0o444)).unwrap();
        assert!(refused(&file).ends_with("the file is write-protected; choose another name"));
        assert!(refused(&directory.path().join("none/file")).ends_with("it does not exist"));
        let link = directory.path().join("link");
        symlink("nowhere", &link).unwrap();
        assert!(refused(&link).ends_with("cannot write: this is a link to what does not exist"));
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        Output::prepare(Path::new("/dev/null"))
            .unwrap()
            .write(b"gone")
            .unwrap();
    }
}
