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
        thread::Builder::new()
            .name("signals".to_owned())
            .stack_size(64 << 10)
            .spawn(move || {
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

#[cfg(all(test, unix))]
mod tests {
    use std::io::{BufRead, BufReader, Read};
    use std::os::unix::process::ExitStatusExt;
    use std::process::{Child, Command, Stdio};

    use fairmesh_process::is_ignored;

    use super::*;

    const DIRECTORY: &str = "FAIRMESH_TEST_DIRECTORY";
    const HELD: &str = "held";

    /// The other process of the tests below: holds a file until its stdin ends.
    #[test]
    #[ignore = "run by the tests of signals"]
    #[allow(clippy::print_stdout, reason = "the other process waits for it")]
    fn a_process_that_holds_a_file() {
        let Some(directory) = std::env::var_os(DIRECTORY) else {
            return;
        };
        let _temporary = Temporary::new(Path::new(&directory)).unwrap();
        println!("{HELD}");
        io::stdin().read_to_end(&mut Vec::new()).unwrap();
    }

    /// That process once it holds a file in the directory, started by this shell command; and what it still says.
    fn holding(directory: &Path, shell: &str) -> (Child, impl Sized) {
        let _ = fs::remove_dir_all(directory);
        fs::create_dir(directory).unwrap();
        let test = "temporary::tests::a_process_that_holds_a_file";
        let mut child = Command::new("sh")
            .args(["-c", &format!("{shell} exec \"$0\" \"$@\"")])
            .arg(std::env::current_exe().unwrap())
            .args(["--exact", test, "--ignored", "--nocapture"])
            .env(DIRECTORY, directory)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        assert!(lines.any(|line| line.unwrap().contains(HELD)));
        assert_eq!(fs::read_dir(directory).unwrap().count(), 1);
        (child, lines)
    }

    fn send(signal: &str, child: &Child) {
        let sent = Command::new("kill")
            .args([signal, &child.id().to_string()])
            .status();
        assert!(sent.unwrap().success());
    }

    #[test]
    fn no_signal_leaves_a_file_behind() {
        let directory = std::env::temp_dir().join(format!("fairmesh-{}-signals", process::id()));
        // Those that are ignored from the start, as by nohup, stay so.
        let all = [("-INT", 2), ("-TERM", 15), ("-HUP", 1), ("-QUIT", 3)];
        for (name, number) in all.into_iter().filter(|(_, number)| !is_ignored(*number)) {
            let (mut child, _said) = holding(&directory, "ulimit -c 0;");
            // Waiting closes it, and the process would end by that.
            let _stdin = child.stdin.take();
            send(name, &child);
            assert_eq!(child.wait().unwrap().signal(), Some(number), "{name}");
            assert_eq!(fs::read_dir(&directory).unwrap().count(), 0, "{name}");
        }
        fs::remove_dir(&directory).unwrap();
    }

    #[test]
    fn a_signal_that_is_ignored_stays_so() {
        let directory = std::env::temp_dir().join(format!("fairmesh-{}-ignored", process::id()));
        let (mut child, _said) = holding(&directory, "trap '' HUP;");
        send("-HUP", &child);
        drop(child.stdin.take());
        assert!(child.wait().unwrap().success());
        assert_eq!(fs::read_dir(&directory).unwrap().count(), 0);
        fs::remove_dir(&directory).unwrap();
    }
}
