//! `packaging/release.sh` makes one commit and a tag, or nothing. Its scripts need GNU sed, so they are run on Linux only.
//! The check of the C interface builds the library; here it is replaced by a script that says what it was asked.
#![cfg(target_os = "linux")]

#[path = "common/command.rs"]
mod command;
#[path = "common/copy.rs"]
mod copy;
#[path = "common/interface.rs"]
mod interface;

use std::fs;
use std::process::Command;

use command::run;
use copy::Copy;

const VERSION: &str = "7.89.10";
const ABI: &str = "ABI: nothing has changed.\n";

/// A repository of its own.
struct Repository(Copy);

impl Repository {
    /// All that is not there yet: the project as it is, committed, with a real address and one line in the changelog.
    fn new(test: &str) -> Self {
        let repository = Repository(Copy::new(test));
        repository.replace("Cargo.toml", ".invalid/", ".example/");
        let changes = format!("# Changelog\n\n## [Unreleased]\n\n{ABI}\n### Added\n\n- Something.\n");
        repository.write("CHANGELOG.md", &changes);
        repository.interface("true");
        repository.git(&["init", "-q", "-b", "main"]);
        repository.commit();
        repository
    }

    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.0.0.join(file)).unwrap()
    }

    fn write(&self, file: &str, text: &str) {
        fs::write(self.0.0.join(file), text).unwrap();
    }

    fn replace(&self, file: &str, old: &str, new: &str) {
        let text = self.read(file);
        assert!(text.contains(old), "{file} has no {old}");
        self.write(file, &text.replace(old, new));
    }

    /// The stand-in of packaging/check_interface.sh: it ends as `command` does.
    fn interface(&self, command: &str) {
        let script = format!("#!/bin/sh\necho \"interface since [$1]\"\n{command}\n");
        self.write("packaging/check_interface.sh", &script);
        for script in ["check_interface.sh", "release.sh", "set_version.sh"] {
            run(Command::new("chmod")
                .arg("+x")
                .arg(self.0.0.join("packaging").join(script)));
        }
    }

    fn git(&self, words: &[&str]) -> String {
        run(Command::new("git")
            .current_dir(&self.0.0)
            .env("GIT_CONFIG_GLOBAL", "/dev/null")
            .args(["-c", "user.name=tester", "-c", "user.email=tester@invalid"])
            .args(words))
    }

    fn commit(&self) {
        self.git(&["add", "-A"]);
        self.git(&["commit", "-q", "-m", "Something else"]);
    }

    /// Runs the script: its exit code, and what it said.
    fn release(&self, words: &[&str]) -> (i32, String) {
        let output = Command::new("bash")
            .arg(self.0.0.join("packaging/release.sh"))
            .args(words)
            .env("GIT_CONFIG_GLOBAL", "/dev/null")
            .env("GIT_AUTHOR_NAME", "tester")
            .env("GIT_AUTHOR_EMAIL", "tester@invalid")
            .env("GIT_COMMITTER_NAME", "tester")
            .env("GIT_COMMITTER_EMAIL", "tester@invalid")
            .output()
            .unwrap();
        let said = [output.stdout, output.stderr].concat();
        let said = String::from_utf8_lossy(&said).into_owned();
        (output.status.code().unwrap(), said)
    }

    /// What the first step of the publishing workflow says of a tag; nothing if it stops there.
    fn tag_is_true(&self, tag: &str) -> String {
        let script = self.0.0.join("packaging/check_tag.sh");
        let output = Command::new("bash").arg(script).arg(tag).output().unwrap();
        assert_eq!(output.status.success(), !output.stdout.is_empty());
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// The commit, the tags, and what is not committed.
    fn state(&self) -> [String; 3] {
        [&["rev-parse", "HEAD"][..], &["tag"], &["status", "--porcelain"]].map(|words| self.git(words))
    }

    /// The script refuses with these words, and nothing has changed.
    fn is_refused(&self, words: &[&str], why: &str) {
        let before = self.state();
        let (code, said) = self.release(words);
        assert_eq!(code, 1, "{said}");
        assert!(said.contains(why), "{said}");
        assert_eq!(self.state(), before);
    }
}

/// What looks for a line stops reading, and what writes must not mind.
#[test]
fn a_long_changelog_is_read() {
    let repository = Repository::new("release_long");
    let long = format!("- Something.\n{}", "- Something else.\n".repeat(20_000));
    repository.replace("CHANGELOG.md", "- Something.\n", &long);
    repository.commit();
    let (code, said) = repository.release(&[VERSION]);
    assert_eq!(code, 0, "{said}");
}

#[test]
fn a_release_is_one_commit_and_a_tag() {
    let repository = Repository::new("release_good");
    let [before, ..] = repository.state();
    let (code, said) = repository.release(&[VERSION]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("interface since []"), "{said}");
    assert_eq!(repository.git(&["rev-parse", "HEAD~1"]), before);
    assert_eq!(repository.git(&["log", "-1", "--format=%s"]), "Release 7.89.10\n");
    assert_eq!(repository.git(&["cat-file", "-t", "v7.89.10"]), "tag\n");
    assert_eq!(
        repository.git(&["rev-parse", "v7.89.10^{commit}"]),
        repository.state()[0]
    );
    assert_eq!(repository.state()[2], "");

    let manifest = repository.read("Cargo.toml");
    assert!(manifest.contains("version = \"7.89.10\"\n"));
    let day = run(Command::new("date").args(["-u", "+%F"]));
    let heading = format!("## [Unreleased]\n\n## [7.89.10] - {day}\n{ABI}");
    assert!(repository.read("CHANGELOG.md").contains(&heading));
    assert_eq!(repository.tag_is_true("v7.89.10"), "v7.89.10 is a release\n");
    assert_eq!(repository.tag_is_true("v7.89.11"), "");
    let dated = format!("version: 7.89.10\ndate-released: {day}");
    assert!(repository.read("CITATION.cff").contains(&dated));

    // The next one: newer, with something in it, and compared with the last one.
    repository.is_refused(&[VERSION], "there is a tag v7.89.10");
    repository.is_refused(&["7.90.0"], "[Unreleased] of CHANGELOG.md is empty");
    let more = format!("## [Unreleased]\n\n{ABI}\n- More.\n");
    repository.replace("CHANGELOG.md", "## [Unreleased]\n", &more);
    repository.commit();
    repository.is_refused(&["7.89.9"], "7.89.9 is older than 7.89.10");
    repository.git(&["tag", "-d", "v7.89.10"]);
    repository.is_refused(&[VERSION], "7.89.10 is not newer than 7.89.10, the last release");
    let (code, said) = repository.release(&["7.90.0"]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("interface since [v7.89.10]"), "{said}");
    let citation = repository.read("CITATION.cff");
    assert_eq!(citation.matches("date-released").count(), 1);
}

#[test]
fn a_dry_run_changes_nothing() {
    let repository = Repository::new("release_dry");
    let before = repository.state();
    let (code, said) = repository.release(&["--dry-run", VERSION]);
    assert_eq!(code, 0, "{said}");
    assert!(
        said.contains("CITATION.cff") && said.contains("can be released"),
        "{said}"
    );
    assert_eq!(repository.state(), before);
}

#[test]
fn what_cannot_be_released_is_refused() {
    let repository = Repository::new("release_refused");
    for words in [
        &[][..],
        &["1.2"],
        &["v7.89.10"],
        &["--dry-run"],
        &["7.89.10", "more"],
    ] {
        assert_eq!(repository.release(words).0, 2, "{words:?}");
    }
    repository.is_refused(&["0.0.1"], "0.0.1 is older than");

    repository.write("new.md", "not committed\n");
    repository.is_refused(&[VERSION], "not committed");
    fs::remove_file(repository.0.0.join("new.md")).unwrap();

    let changes = repository.read("CHANGELOG.md");
    for (old, why) in [
        ("- Something.\n", "is empty"),
        (ABI, "has no line \"ABI"),
        ("## [Unreleased]\n", "has no part [Unreleased]"),
    ] {
        repository.replace("CHANGELOG.md", old, "");
        repository.commit();
        repository.is_refused(&[VERSION], why);
        repository.write("CHANGELOG.md", &changes);
    }
    repository.commit();

    // What was written before the check said no is taken back.
    repository.interface("false");
    repository.commit();
    repository.is_refused(&[VERSION], "the C interface does not agree");
    repository.interface("true");
    repository.replace("Cargo.toml", ".example/", ".invalid/");
    repository.commit();
    repository.is_refused(&[VERSION], "is not the real one");
}

/// Where the binary interface is described: it has the end of the SONAME in its name.
fn stored_interface() -> String {
    format!("packaging/libfairmesh.so.{}.abi", interface::interface())
}

/// What abidiff is told not to mind, if the binary interface was `old`: nothing but structs that have grown.
fn grown(copy: &Copy, old: &str) -> String {
    let stored = copy.0.join(stored_interface());
    let last = copy.0.join("last.abi");
    fs::write(&last, old).unwrap();
    run(Command::new("python3")
        .arg(copy.0.join("packaging/grown_structs.py"))
        .args([last, stored]))
}

#[test]
#[ignore = "full tier: needs python3"]
fn structs_may_grow_at_their_ends_alone() {
    let copy = Copy::new("release_interface");
    let stored = stored_interface();
    let text = fs::read_to_string(copy.0.join(stored)).unwrap();
    assert_eq!(grown(&copy, &text), "");
    let start = text.find("<class-decl name='fairmesh_options'").unwrap();
    let options = &text[start..start + text[start..].find("</class-decl>").unwrap()];

    // The last field is new; the first one is new.
    let end = options.rfind("<data-member").unwrap();
    let shorter = text.replace(options, &options[..end]);
    assert!(grown(&copy, &shorter).contains("(^|::)fairmesh_options$"));
    let first = options.find("<data-member").unwrap();
    let second = first + 1 + options[first + 1..].find("<data-member").unwrap();
    let behind = text.replace(options, &format!("{}{}", &options[..first], &options[second..]));
    assert_eq!(grown(&copy, &behind), "");
}
