//! Where the time of a run goes, for the benchmark `profile`. Without the feature of that name nothing is measured.

pub(crate) use clocks::clock;
#[cfg(feature = "profile")]
pub use clocks::take_profile;

/// Nothing.
#[cfg(not(feature = "profile"))]
mod clocks {
    /// Nothing.
    pub(crate) struct Clock;

    /// Does nothing.
    #[inline(always)]
    pub(crate) fn clock(_part: &'static str) -> Clock {
        Clock
    }
}

#[cfg(feature = "profile")]
mod clocks {
    use std::cell::Cell;
    use std::collections::BTreeMap;
    use std::sync::{Mutex, PoisonError};
    use std::time::{Duration, Instant};

    static SPENT: Mutex<BTreeMap<&str, Duration>> = Mutex::new(BTreeMap::new());

    thread_local! {
        /// The part that this thread's time counts for, and since when.
        static CURRENT: Cell<Option<(&'static str, Instant)>> = const { Cell::new(None) };
    }

    /// While it is there, time counts for its part, and not for the one around it.
    pub(crate) struct Clock {
        around: Option<&'static str>,
    }

    /// Lets the time of this thread count for `part`, until what is returned is dropped.
    pub(crate) fn clock(part: &'static str) -> Clock {
        Clock {
            around: count_for(Some(part)),
        }
    }

    impl Drop for Clock {
        fn drop(&mut self) {
            count_for(self.around);
        }
    }

    /// Returns what it counted for so far.
    fn count_for(part: Option<&'static str>) -> Option<&'static str> {
        let now = Instant::now();
        let (before, since) = CURRENT.replace(part.map(|part| (part, now)))?;
        let mut spent = SPENT.lock().unwrap_or_else(PoisonError::into_inner);
        *spent.entry(before).or_default() += now - since;
        Some(before)
    }

    /// The seconds that all threads together have spent on each part of the runs since the last call, by name.
    ///
    /// ```
    /// # use fairmesh::{Options, Selection, fair, take_profile};
    /// let positions = [[1., 0., 0.], [0., 1., 0.], [-1., -1., 0.], [0., 0., 1.]];
    /// let triangles = [[0, 1, 3], [1, 2, 3], [2, 0, 3]];
    /// let options = Options { threads: 1, ..Options::default() };
    /// take_profile();
    /// let solution = fair(&positions, &triangles, Selection::Vertices(&[3]), &options)?;
    /// let spent: f64 = take_profile().values().sum();
    /// assert!(spent > 0.0 && spent <= solution.report.seconds.total);
    /// # Ok::<(), fairmesh::Error>(())
    /// ```
    pub fn take_profile() -> BTreeMap<&'static str, f64> {
        let mut spent = SPENT.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = std::mem::take(&mut *spent).into_iter();
        taken.map(|(part, time)| (part, time.as_secs_f64())).collect()
    }
}
