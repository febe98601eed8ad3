//! Memory that begins with a cache line.
//!
//! Reading matrices is most of what a step of an elastic dam costs, eight numbers at a time. Eight numbers that lie across
//! two lines take as long as two reads, and memory of the system begins anywhere: a step took up to a third longer.

use std::alloc::{GlobalAlloc, Layout, System};

/// Bytes of a cache line.
const LINE: usize = 64;
/// What is smaller is left to the system, whose way is shorter.
const LARGE: usize = 8 * LINE;

/// The system's memory, in whole lines where it is a large piece.
pub(crate) struct WholeLines;

fn in_lines(layout: Layout) -> Layout {
    if layout.size() < LARGE {
        return layout;
    }
    layout.align_to(LINE).unwrap_or(layout)
}

// Safety: all is left to the system, by the same layout for a piece of the same size.
unsafe impl GlobalAlloc for WholeLines {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        unsafe { System.alloc(in_lines(layout)) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        unsafe { System.alloc_zeroed(in_lines(layout)) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        unsafe { System.dealloc(at, in_lines(layout)) }
    }
}
