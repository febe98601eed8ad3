//! Work beside Python, which may interrupt it, and to which nothing but an exception ever comes.

use std::any::Any;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{channel, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use heeltoe::stop::Stop;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// How long an interruption (Ctrl-C) may wait until it is seen.
const OFTEN: Duration = Duration::from_millis(50);

/// Let `work` run on a thread of its own while this one, which alone hears of signals, listens for them.
///
/// # Errors
/// What a signal raises, once the work has stopped; a note says how far it had come, where `reached` knows that. A panic
/// is an internal error.
pub fn watched<T: Send>(
    py: Python<'_>,
    reached: fn(&T) -> Option<f64>,
    work: impl FnOnce(Stop) -> T + Send,
) -> PyResult<T> {
    let flag = AtomicBool::new(false);
    let mut raised = None;
    let done = thread::scope(|scope| {
        let (send, receive) = channel();
        let flag = &flag;
        let worker = scope.spawn(move || {
            // Nobody listens any more only where listening itself has failed.
            let done = work(Stop::once(flag));
            let _ = send.send(());
            done
        });
        let mut receive = receive;
        loop {
            let (heard, back) = py.detach(move || (receive.recv_timeout(OFTEN), receive));
            receive = back;
            if heard != Err(RecvTimeoutError::Timeout) {
                break;
            }
            if let Err(error) = py.check_signals() {
                flag.store(true, Ordering::Relaxed);
                raised = Some(error);
            }
        }
        worker.join()
    })
    .map_err(internal)?;
    let Some(error) = raised else {
        return Ok(done);
    };
    if let Some(time) = reached(&done) {
        let note = format!("the run had come to {time:.2} s of the earthquake");
        error.value(py).call_method1("add_note", (note,))?;
    }
    Err(error)
}

/// A panic as an error for Python.
fn internal(panic: Box<dyn Any + Send>) -> PyErr {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    PyRuntimeError::new_err(format!(
        "internal error of the kernel, please report it: {}",
        text.unwrap_or("no reason given")
    ))
}
