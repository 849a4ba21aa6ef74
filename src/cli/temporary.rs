//! A new file beside its target that no end of the program leaves behind: neither an error nor a signal.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The names that stand in directories now. A signal removes them; while the lock is held, none comes or goes.
static NAMES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn names() -> MutexGuard<'static, Vec<PathBuf>> {
    NAMES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A new file that is removed at the end unless it was renamed.
pub struct Temporary {
    path: PathBuf,
    file: File,
}

impl Temporary {
    /// An empty file in this directory.
    pub fn new(directory: &Path) -> io::Result<Self> {
        #[cfg(unix)]
        signals::watch()?;
        let mut number = 0;
        loop {
            let path = directory.join(format!(".fairmesh-{}-{number}", process::id()));
            let mut names = names();
            // Before the file is made: memory that runs out ends the program.
            names.push(path.clone());
            match File::create_new(&path) {
                Ok(file) => return Ok(Self { path, file }),
                Err(why) => {
                    names.pop();
                    if why.kind() != io::ErrorKind::AlreadyExists {
                        return Err(why);
                    }
                    number += 1;
                }
            }
        }
    }

    /// The open file.
    pub fn file(&self) -> &File {
        &self.file
    }

    /// Gives it its name, in place of what has it now.
    pub fn rename(self, target: &Path) -> io::Result<()> {
        let mut names = names();
        fs::rename(&self.path, target)?;
        names.retain(|name| *name != self.path);
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let mut names = names();
        // Not if it was renamed: by now the name may be another's.
        if let Some(at) = names.iter().position(|name| *name == self.path) {
            let _ = fs::remove_file(names.swap_remove(at));
        }
    }
}

#[cfg(unix)]
mod signals {
    //! A thread that waits for signals, removes what is temporary, and lets the signal do what it does.

    use std::sync::atomic::AtomicBool;
    use std::sync::{Arc, Mutex, PoisonError};
    use std::{fs, io, process, thread};

    use fairmesh_process::{FILE_TOO_LARGE, is_ignored};
    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::{flag, low_level};

    static IS_WATCHED: Mutex<bool> = Mutex::new(false);

    /// Starts the thread, once.
    pub(super) fn watch() -> io::Result<()> {
        let mut is_watched = IS_WATCHED.lock().unwrap_or_else(PoisonError::into_inner);
        if *is_watched {
            return Ok(());
        }
        flag::register(FILE_TOO_LARGE, Arc::new(AtomicBool::new(false)))?;
        let ours = [SIGHUP, SIGINT, SIGQUIT, SIGTERM]
            .into_iter()
            .filter(|&signal| !is_ignored(signal));
        let mut signals = Signals::new(ours)?;
        thread::Builder::new().name("signals".to_owned()).spawn(move || {
            if let Some(signal) = signals.forever().next() {
                end(signal);
            }
        })?;
        *is_watched = true;
        Ok(())
    }

    fn end(signal: i32) {
        // Held to the end: no new file comes now.
        let names = super::names();
        for name in names.iter() {
            let _ = fs::remove_file(name);
        }
        let _ = low_level::emulate_default_handler(signal);
        process::exit(128 + signal);
    }
}
