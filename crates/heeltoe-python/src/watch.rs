//! Work beside Python, which may interrupt it, and to which nothing but an exception ever comes.

use std::any::Any;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{channel, RecvTimeoutError};
use std::sync::Mutex;
use std::thread;
use std::time::Duration;

use heeltoe::stop::Stop;
use pyo3::create_exception;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;

create_exception!(heeltoe.kernel._kernel, InternalError, PyRuntimeError);

/// What ends runs on other threads than the one that hears of signals; see `_kernel.pyi`.
#[pyclass(frozen)]
#[derive(Default)]
pub struct Ending {
    flag: AtomicBool,
}

#[pymethods]
impl Ending {
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// See `_kernel.pyi`.
    fn ask(&self) {
        self.flag.store(true, Ordering::Relaxed);
    }
}

/// Whether Python has heard of the last interruption.
#[cfg(unix)]
static HEARD: AtomicBool = AtomicBool::new(true);

/// See `_kernel.pyi`.
#[cfg(unix)]
#[pyfunction]
pub fn end_if_deaf(descriptor: i32, seconds: f64) {
    use std::io::{Read, Write};
    use std::os::fd::FromRawFd;

    extern "C" {
        fn _exit(code: i32) -> !;
    }
    const INTERRUPTION: u8 = 2;
    // SAFETY: Python has made the descriptor for this thread alone, and never closes it.
    let mut signals = unsafe { std::fs::File::from_raw_fd(descriptor) };
    let patience = Duration::from_secs_f64(seconds);
    thread::spawn(move || {
        let mut number = [0];
        while signals.read_exact(&mut number).is_ok() {
            if number[0] != INTERRUPTION {
                continue;
            }
            HEARD.store(false, Ordering::Relaxed);
            // Python hears at its next step, if it is not deep in a library.
            thread::sleep(patience);
            if !HEARD.load(Ordering::Relaxed) {
                let _ = std::io::stderr().write_all(b"heeltoe: interrupted\n");
                // SAFETY: nothing of this process runs after it; what it has put aside the next one removes.
                unsafe { _exit(130) }
            }
        }
    });
}

/// See `_kernel.pyi`.
#[cfg(unix)]
#[pyfunction]
pub fn hear_interruption() {
    HEARD.store(true, Ordering::Relaxed);
}

/// How long an interruption (Ctrl-C) may wait until it is seen.
const OFTEN: Duration = Duration::from_millis(50);

/// Let `work` run that is over before anybody could wait for it: a thread of its own would take longer to start.
///
/// # Errors
/// A panic is an internal error.
pub fn prompt<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    py.detach(|| catch_unwind(AssertUnwindSafe(work)))
        .map_err(internal)
}

/// Let `work` run on a thread of its own while this one, which alone hears of signals, listens for them.
///
/// # Errors
/// What a signal raises, or an interruption where `ending` asks for one, once the work has stopped; a note says time (s)
/// and slip (m) it had come to, where `reached` knows them. A panic is an internal error.
pub fn watched<T: Send>(
    py: Python<'_>,
    ending: Option<&Ending>,
    reached: fn(&T) -> Option<[f64; 2]>,
    work: impl FnOnce(Stop) -> T + Send,
) -> PyResult<T> {
    let own = AtomicBool::new(false);
    let flag = ending.map_or(&own, |ending| &ending.flag);
    let mut raised = None;
    let done = thread::scope(|scope| {
        let (send, receive) = channel();
        let worker = scope.spawn(move || {
            // No one listens any more only where listening itself has failed.
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
    if !flag.load(Ordering::Relaxed) {
        return Ok(done);
    }
    let error = raised.unwrap_or_else(|| PyKeyboardInterrupt::new_err(()));
    if let Some([time, slip]) = reached(&done) {
        let slip = 1e3 * slip + 0.0;
        let note = format!("the run had come to {time:.2} s of the earthquake and {slip:.1} mm of slip");
        error.value(py).call_method1("add_note", (note,))?;
    }
    Err(error)
}

/// Where the last panic was.
static PLACE: Mutex<String> = Mutex::new(String::new());

/// Let panics be told by their errors alone.
pub fn quiet() {
    std::panic::set_hook(Box::new(|panic| {
        if let (Some(place), Ok(mut last)) = (panic.location(), PLACE.lock()) {
            *last = place.to_string();
        }
    }));
}

/// A panic as an error for Python.
fn internal(panic: Box<dyn Any + Send>) -> PyErr {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    let place = PLACE.lock().map(|place| place.clone()).unwrap_or_default();
    InternalError::new_err(format!("{} ({place})", text.unwrap_or("no reason given")))
}
