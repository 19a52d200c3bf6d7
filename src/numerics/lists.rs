//! Locks of the few lists that instances of a process share.
//!
//! A child that was forked while another thread had one of them finds it locked for ever: the thread that would open it
//! is not there. Each is held for the length of a look-up or an entry only, so that one which stays locked has no
//! holder, and whoever asks does without the list.

use std::sync::{Mutex, MutexGuard, TryLockError};
use std::thread;
use std::time::Duration;

/// Waits, and how long each is: together a hundred times what a thread that the system has interrupted may hold it.
const WAITS: usize = 5000;
const WAIT: Duration = Duration::from_micros(100);

/// What a lock guards; `None` if nobody is there to open it. It is in order even if a panic has passed by: nothing that
/// is done under it can stop half-way.
pub fn opened<T>(list: &Mutex<T>) -> Option<MutexGuard<'_, T>> {
    for _ in 0..WAITS {
        match list.try_lock() {
            Ok(guard) => return Some(guard),
            Err(TryLockError::Poisoned(guard)) => return Some(guard.into_inner()),
            Err(TryLockError::WouldBlock) => thread::sleep(WAIT),
        }
    }
    None
}
