//! Memory that Rust cannot get: words and an exit code in the place of an abort.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// What is done when memory is refused; takes the bytes that were asked for.
static REFUSED: OnceLock<fn(usize)> = OnceLock::new();
/// Given back then: words and ends need some memory, too.
static RESERVE: Mutex<Option<Vec<u8>>> = Mutex::new(None);
const RESERVED: usize = 1 << 20;
/// Whether it is being done: it may need memory itself.
static ENTERED: AtomicBool = AtomicBool::new(false);

/// The allocator of the system, which calls what [`when_memory_is_refused`] was given before it gives nothing.
pub struct TellingAllocator;

/// From now on `act` is called, once, when Rust cannot get memory; if it returns, the process is aborted as ever.
pub fn when_memory_is_refused(act: fn(usize)) {
    *RESERVE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Vec::with_capacity(RESERVED));
    let _ = REFUSED.set(act);
}

/// Threads that are started from now on get their memory where the first one does: otherwise glibc reserves 64 MiB of address space
/// and more for each, and `ulimit -v` leaves a run that much less.
pub fn share_memory_among_threads() {
    unsafe { super::ffi::mezha_share_arena() }
}

#[cold]
fn refused(bytes: usize) {
    if let Some(act) = REFUSED.get().filter(|_| !ENTERED.swap(true, Ordering::Relaxed)) {
        drop(RESERVE.try_lock().ok().and_then(|mut reserve| reserve.take()));
        act(bytes);
    }
}

/// Hands on what the system gives, and tells of what it refuses.
#[inline]
fn told(memory: *mut u8, bytes: usize) -> *mut u8 {
    if memory.is_null() {
        refused(bytes);
    }
    memory
}

// Everything goes to the allocator of the system as it came.
unsafe impl GlobalAlloc for TellingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        told(unsafe { System.alloc(layout) }, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        told(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        told(unsafe { System.realloc(memory, layout, size) }, size)
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }
}
