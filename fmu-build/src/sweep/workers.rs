//! Jobs on several threads, whose results one thread takes as they come.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use anyhow::Result;

use crate::interrupt;

/// Does `job(0)` … `job(count − 1)` on so many threads; `take` has the results, in no order. Where it fails no further
/// job begins, and its error is the answer; nor does one begin once the user has interrupted.
pub(super) fn each<T: Send>(
    threads: usize,
    count: usize,
    job: impl Fn(usize) -> T + Sync,
    mut take: impl FnMut(usize, T) -> Result<()>,
) -> Result<()> {
    let (next, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    // A few results wait at most: rows must not gather in memory while the disk is busy.
    let (give, results) = mpsc::sync_channel(2 * threads);
    thread::scope(|scope| {
        for _ in 0..threads.min(count) {
            let give = give.clone();
            scope.spawn(|| {
                let give = give;
                while !stopped.load(Ordering::Relaxed) && !interrupt::came() {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count || give.send((index, job(index))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(give);
        let done = results.iter().try_for_each(|(index, result)| take(index, result));
        stopped.store(true, Ordering::Relaxed);
        // Who waits to give a result gets an error: nobody takes it.
        drop(results);
        done
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn every_job_is_done_once_and_a_failure_ends_them_without_a_deadlock() {
        for threads in [1, 2, 7] {
            let mut seen = vec![0; 100];
            each(
                threads,
                100,
                |index| index * index,
                |index, square| {
                    assert_eq!(square, index * index);
                    seen[index] += 1;
                    Ok(())
                },
            )
            .unwrap();
            assert!(seen.iter().all(|&times| times == 1));
            let mut taken = 0;
            let failed = each(
                threads,
                100_000,
                |index| index,
                |_, _| {
                    taken += 1;
                    if taken == 5 { anyhow::bail!("full") } else { Ok(()) }
                },
            );
            assert_eq!((failed.unwrap_err().to_string().as_str(), taken), ("full", 5));
        }
        each(3, 0, |_| (), |_, ()| Ok(())).unwrap();
    }
}
