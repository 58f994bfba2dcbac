//! [`in_order`]: processes the items of a stream in parallel and returns the results in order, with bounded memory.
//!
//! One thread reads the items, several workers compute the answers, and the calling thread receives the answers. An
//! item counts towards the [`Capacity`] from the time it is queued until its answer has been received. A slow item or a
//! slow receiver therefore stops the reader, and the memory stays bounded.

use std::collections::{BTreeMap, VecDeque};
use std::ops::ControlFlow;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// Limits for the items that are in progress at the same time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capacity {
    /// The number of worker threads.
    pub threads: usize,
    /// The largest number of items in progress.
    pub items: usize,
    /// The largest number of bytes in progress. A single item may be larger.
    pub bytes: usize,
}

impl Capacity {
    /// Returns the limits for `threads` worker threads: 64 items in progress per thread, so that a slow item does not
    /// stop the others, and 64 MiB in total.
    pub fn new(threads: usize) -> Capacity {
        let threads = threads.max(1);
        Capacity { threads, items: 64 * threads, bytes: 64 << 20 }
    }
}

/// The memory that an item occupies.
pub trait ByteSize {
    /// Returns the approximate size of the item in memory, in bytes.
    fn byte_size(&self) -> usize;
}

/// The queue between the reader and the workers.
struct State<T> {
    /// Items that no worker has taken yet, with their numbers.
    waiting: VecDeque<(u64, T)>,
    /// The number of items in progress.
    items: usize,
    /// The total size of the items in progress, in bytes.
    bytes: usize,
    /// Whether the reader has reached the end of the input.
    ended: bool,
    /// Whether the receiver needs no more answers.
    stopped: bool,
}

struct Shared<T> {
    state: Mutex<State<T>>,
    /// Signalled when an item is waiting, the input has ended, or the receiver has stopped.
    work: Condvar,
    /// Signalled when an answer was received, which leaves space for an item, or when the receiver has stopped.
    space: Condvar,
}

impl<T> Shared<T> {
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        // Ignore poisoning: a thread that panicked while it held the lock cannot have left the counts or the list
        // half changed.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Calls `work` for every item of a stream in several threads. Calls `receive` for every answer, in the order of the
/// stream.
///
/// `receive` is called with `None` whenever no answer is ready, so that it can flush its output. If `receive` returns
/// `Break`, this function returns, and each thread ends after its current item. A thread that waits for input ends only
/// when the input arrives.
///
/// # Panics
///
/// `work` must not panic. After a panic, `in_order` may wait forever, or return without the answers that are missing.
pub fn in_order<T, R>(
    input: impl Iterator<Item = T> + Send + 'static,
    capacity: Capacity,
    work: impl Fn(T) -> R + Send + Sync + 'static,
    mut receive: impl FnMut(Option<R>) -> ControlFlow<()>,
) where
    T: ByteSize + Send + 'static,
    R: Send + 'static,
{
    let shared = Arc::new(Shared {
        state: Mutex::new(State { waiting: VecDeque::new(), items: 0, bytes: 0, ended: false, stopped: false }),
        work: Condvar::new(),
        space: Condvar::new(),
    });
    let (sender, answers) = channel();
    let work = Arc::new(work);
    for _ in 0..capacity.threads.max(1) {
        let (shared, work, sender) = (Arc::clone(&shared), Arc::clone(&work), sender.clone());
        thread::spawn(move || answer_all(&shared, &*work, &sender));
    }
    drop(sender);
    let reading = Arc::clone(&shared);
    thread::spawn(move || read_all(&reading, input, capacity));
    receive_all(&shared, &answers, &mut receive);
    let mut state = shared.lock();
    state.stopped = true;
    state.waiting.clear();
    drop(state);
    shared.work.notify_all();
    shared.space.notify_all();
}

/// Reads items and queues them for the workers. Waits while the items in progress fill the capacity. Runs in the
/// reading thread.
fn read_all<T: ByteSize>(shared: &Shared<T>, input: impl Iterator<Item = T>, capacity: Capacity) {
    for (number, item) in (0..).zip(input) {
        let size = item.byte_size();
        let mut state = shared.lock();
        let is_full = |s: &State<T>| s.items > 0 && (s.items >= capacity.items || s.bytes + size > capacity.bytes);
        while is_full(&state) && !state.stopped {
            state = shared.space.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        if state.stopped {
            return;
        }
        state.items += 1;
        state.bytes += size;
        state.waiting.push_back((number, item));
        drop(state);
        shared.work.notify_one();
    }
    shared.lock().ended = true;
    shared.work.notify_all();
}

/// Takes items from the queue, processes them and sends the answers, until the input has ended or the receiver has
/// stopped. Runs in each worker thread.
fn answer_all<T: ByteSize, R>(shared: &Shared<T>, work: &impl Fn(T) -> R, answers: &Sender<(u64, usize, R)>) {
    loop {
        let mut state = shared.lock();
        let (number, item) = loop {
            if state.stopped {
                return;
            }
            match state.waiting.pop_front() {
                Some(next) => break next,
                None if state.ended => return,
                None => {
                    state = shared.work.wait(state).unwrap_or_else(PoisonError::into_inner);
                }
            }
        };
        drop(state);
        let size = item.byte_size();
        if answers.send((number, size, work(item))).is_err() {
            return;
        }
    }
}

/// Sorts the answers into the order of the items and passes them to `receive`. Runs in the calling thread.
fn receive_all<T, R>(
    shared: &Shared<T>,
    answers: &Receiver<(u64, usize, R)>,
    receive: &mut impl FnMut(Option<R>) -> ControlFlow<()>,
) {
    // Answers that arrived before the answers of earlier items.
    let mut early: BTreeMap<u64, (usize, R)> = BTreeMap::new();
    let mut next = 0;
    loop {
        let (number, size, answer) = match answers.try_recv() {
            Ok(answer) => answer,
            Err(TryRecvError::Empty) => {
                if receive(None).is_break() {
                    return;
                }
                match answers.recv() {
                    Ok(answer) => answer,
                    Err(_) => return,
                }
            }
            Err(TryRecvError::Disconnected) => {
                let _ = receive(None);
                return;
            }
        };
        early.insert(number, (size, answer));
        let (mut items, mut bytes) = (0, 0);
        while let Some((size, answer)) = early.remove(&next) {
            next += 1;
            items += 1;
            bytes += size;
            if receive(Some(answer)).is_break() {
                return;
            }
        }
        if items > 0 {
            let mut state = shared.lock();
            state.items -= items;
            state.bytes -= bytes;
            drop(state);
            shared.space.notify_one();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    use super::*;

    impl ByteSize for usize {
        fn byte_size(&self) -> usize {
            100
        }
    }

    const CAPACITY: Capacity = Capacity { threads: 4, items: 16, bytes: 1_000_000 };

    #[test]
    fn answers_come_in_order_however_long_each_takes() {
        let work = |n: usize| {
            thread::sleep(Duration::from_micros((n * 7919 % 13) as u64 * 100));
            n
        };
        let mut received = Vec::new();
        in_order(0..500, CAPACITY, work, |answer| {
            received.extend(answer);
            ControlFlow::Continue(())
        });
        assert_eq!(received, (0..500).collect::<Vec<_>>());
    }

    #[test]
    fn no_more_items_are_read_than_the_capacity_allows() {
        for (capacity, most) in [(CAPACITY, 16), (Capacity { bytes: 500, ..CAPACITY }, 5)] {
            let read = Arc::new(AtomicUsize::new(0));
            let counted = Arc::clone(&read);
            let input = (0..200).inspect(move |_| {
                counted.fetch_add(1, Ordering::SeqCst);
            });
            let mut received = 0;
            let mut worst = 0;
            in_order(
                input,
                capacity,
                |n: usize| n,
                |answer| {
                    // The item that waits for space has been read too.
                    worst = worst.max(read.load(Ordering::SeqCst) - received);
                    received += answer.iter().count();
                    thread::sleep(Duration::from_micros(50));
                    ControlFlow::Continue(())
                },
            );
            assert_eq!(received, 200);
            assert!(worst <= most + 1, "{worst} in progress, and the limit is {most}");
        }
    }

    #[test]
    fn an_item_larger_than_the_capacity_is_processed() {
        let mut received = 0;
        let capacity = Capacity { bytes: 10, ..CAPACITY };
        in_order(
            0..20,
            capacity,
            |n: usize| n,
            |answer| {
                received += answer.iter().count();
                ControlFlow::Continue(())
            },
        );
        assert_eq!(received, 20);
    }

    #[test]
    fn a_receiver_stops_an_input_that_never_ends() {
        let mut received = 0;
        in_order(
            0..,
            CAPACITY,
            |n: usize| n,
            |answer| {
                received += answer.iter().count();
                match received {
                    100 => ControlFlow::Break(()),
                    _ => ControlFlow::Continue(()),
                }
            },
        );
        assert_eq!(received, 100);
    }

    #[test]
    fn an_answer_is_received_before_the_next_item_arrives() {
        let (sender, receiver) = channel::<usize>();
        sender.send(0).expect("the input is open");
        let mut received = Vec::new();
        in_order(
            receiver.into_iter(),
            CAPACITY,
            |n| n,
            |answer| {
                received.extend(answer);
                // The next item is sent only after the last answer.
                match (answer, received.len()) {
                    (Some(_), 3) => return ControlFlow::Break(()),
                    (Some(n), _) => sender.send(n + 1).expect("the input is open"),
                    (None, _) => {}
                }
                ControlFlow::Continue(())
            },
        );
        assert_eq!(received, [0, 1, 2]);
    }
}
