//! [`in_order`]: work on a stream by several threads, answers in the order of the stream, within bounded memory.
//!
//! One thread reads, several work, and the caller's own takes the answers. An item counts from when it is read until its
//! answer was taken, so that a slow item, or a slow taker, holds the reader back and not the memory full.

use std::collections::{BTreeMap, VecDeque};
use std::ops::ControlFlow;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// How much is under way at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capacity {
    /// Threads that work.
    pub threads: usize,
    /// Items read whose answers were not taken yet, at most.
    pub items: usize,
    /// Bytes of these, at most; a single item may be larger.
    pub bytes: usize,
}

impl Capacity {
    /// For so many threads.
    pub fn new(threads: usize) -> Capacity {
        let threads = threads.max(1);
        Capacity {
            threads,
            items: 64 * threads,
            bytes: 64 << 20,
        }
    }
}

/// How many bytes an item holds.
pub trait ByteSize {
    /// In bytes, about.
    fn weight(&self) -> usize;
}

struct State<T> {
    waiting: VecDeque<(u64, T)>,
    items: usize,
    bytes: usize,
    ended: bool,
    stopped: bool,
}

struct Shared<T> {
    state: Mutex<State<T>>,
    work: Condvar,
    room: Condvar,
}

impl<T> Shared<T> {
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        // Counts and a list are sound at every moment, whoever held them last.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Answers every item of a stream and hands the answers to `taken` in the stream's order.
///
/// `taken` is called with `None` whenever no answer is ready, which is the time to flush, and ends everything by
/// `Break`. The reader is left behind where it waits for input that nobody needs any more.
///
/// # Panics
/// `work` must not panic: its answer would be waited for in vain.
pub fn in_order<T, R>(
    input: impl Iterator<Item = T> + Send + 'static,
    room: Capacity,
    work: impl Fn(T) -> R + Send + Sync + 'static,
    mut taken: impl FnMut(Option<R>) -> ControlFlow<()>,
) where
    T: ByteSize + Send + 'static,
    R: Send + 'static,
{
    let shared = Arc::new(Shared {
        state: Mutex::new(State {
            waiting: VecDeque::new(),
            items: 0,
            bytes: 0,
            ended: false,
            stopped: false,
        }),
        work: Condvar::new(),
        room: Condvar::new(),
    });
    let (sender, answers) = channel();
    let work = Arc::new(work);
    for _ in 0..room.threads.max(1) {
        let (shared, work, sender) = (Arc::clone(&shared), Arc::clone(&work), sender.clone());
        thread::spawn(move || answer_all(&shared, &*work, &sender));
    }
    drop(sender);
    let reading = Arc::clone(&shared);
    thread::spawn(move || read_all(&reading, input, room));
    take_all(&shared, &answers, &mut taken);
    let mut state = shared.lock();
    state.stopped = true;
    state.waiting.clear();
    drop(state);
    shared.work.notify_all();
    shared.room.notify_all();
}

fn read_all<T: ByteSize>(shared: &Shared<T>, input: impl Iterator<Item = T>, room: Capacity) {
    for (number, item) in (0..).zip(input) {
        let weight = item.weight();
        let mut state = shared.lock();
        let is_full =
            |s: &State<T>| s.items > 0 && (s.items >= room.items || s.bytes + weight > room.bytes);
        while is_full(&state) && !state.stopped {
            state = shared
                .room
                .wait(state)
                .unwrap_or_else(PoisonError::into_inner);
        }
        if state.stopped {
            return;
        }
        state.items += 1;
        state.bytes += weight;
        state.waiting.push_back((number, item));
        drop(state);
        shared.work.notify_one();
    }
    shared.lock().ended = true;
    shared.work.notify_all();
}

fn answer_all<T: ByteSize, R>(
    shared: &Shared<T>,
    work: &impl Fn(T) -> R,
    answers: &Sender<(u64, usize, R)>,
) {
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
                    state = shared
                        .work
                        .wait(state)
                        .unwrap_or_else(PoisonError::into_inner);
                }
            }
        };
        drop(state);
        let weight = item.weight();
        if answers.send((number, weight, work(item))).is_err() {
            return;
        }
    }
}

fn take_all<T, R>(
    shared: &Shared<T>,
    answers: &Receiver<(u64, usize, R)>,
    taken: &mut impl FnMut(Option<R>) -> ControlFlow<()>,
) {
    // Answers that came before their turn.
    let mut early: BTreeMap<u64, (usize, R)> = BTreeMap::new();
    let mut next = 0;
    loop {
        let (number, weight, answer) = match answers.try_recv() {
            Ok(answer) => answer,
            Err(TryRecvError::Empty) => {
                if taken(None).is_break() {
                    return;
                }
                match answers.recv() {
                    Ok(answer) => answer,
                    Err(_) => return,
                }
            }
            Err(TryRecvError::Disconnected) => {
                let _ = taken(None);
                return;
            }
        };
        early.insert(number, (weight, answer));
        let (mut items, mut bytes) = (0, 0);
        while let Some((weight, answer)) = early.remove(&next) {
            next += 1;
            items += 1;
            bytes += weight;
            if taken(Some(answer)).is_break() {
                return;
            }
        }
        if items > 0 {
            let mut state = shared.lock();
            state.items -= items;
            state.bytes -= bytes;
            drop(state);
            shared.room.notify_one();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    use super::*;

    impl ByteSize for usize {
        fn weight(&self) -> usize {
            100
        }
    }

    const ROOM: Capacity = Capacity {
        threads: 4,
        items: 16,
        bytes: 1_000_000,
    };

    #[test]
    fn answers_come_in_order_however_long_each_takes() {
        let work = |n: usize| {
            thread::sleep(Duration::from_micros((n * 7919 % 13) as u64 * 100));
            n
        };
        let mut described = Vec::new();
        in_order(0..500, ROOM, work, |answer| {
            described.extend(answer);
            ControlFlow::Continue(())
        });
        assert_eq!(described, (0..500).collect::<Vec<_>>());
    }

    #[test]
    fn no_more_is_read_than_there_is_room_for() {
        for (room, most) in [(ROOM, 16), (Capacity { bytes: 500, ..ROOM }, 5)] {
            let read = Arc::new(AtomicUsize::new(0));
            let counted = Arc::clone(&read);
            let input = (0..200).inspect(move |_| {
                counted.fetch_add(1, Ordering::SeqCst);
            });
            let mut taken = 0;
            let mut worst = 0;
            in_order(
                input,
                room,
                |n: usize| n,
                |answer| {
                    // The one that waits for room has been read too.
                    worst = worst.max(read.load(Ordering::SeqCst) - taken);
                    taken += answer.iter().count();
                    thread::sleep(Duration::from_micros(50));
                    ControlFlow::Continue(())
                },
            );
            assert_eq!(taken, 200);
            assert!(worst <= most + 1, "{worst} under way in a room for {most}");
        }
    }

    #[test]
    fn one_item_larger_than_the_room_goes_through() {
        let mut described = 0;
        let room = Capacity { bytes: 10, ..ROOM };
        in_order(
            0..20,
            room,
            |n: usize| n,
            |answer| {
                described += answer.iter().count();
                ControlFlow::Continue(())
            },
        );
        assert_eq!(described, 20);
    }

    #[test]
    fn a_taker_who_has_enough_ends_it_though_the_input_never_ends() {
        let mut described = 0;
        in_order(
            0..,
            ROOM,
            |n: usize| n,
            |answer| {
                described += answer.iter().count();
                match described {
                    100 => ControlFlow::Break(()),
                    _ => ControlFlow::Continue(()),
                }
            },
        );
        assert_eq!(described, 100);
    }

    #[test]
    fn an_answer_is_handed_on_before_the_next_item_comes() {
        let (sender, receiver) = channel::<usize>();
        sender.send(0).expect("open");
        let mut described = Vec::new();
        in_order(
            receiver.into_iter(),
            ROOM,
            |n| n,
            |answer| {
                described.extend(answer);
                // The next item is sent only once the last was answered.
                match (answer, described.len()) {
                    (Some(_), 3) => return ControlFlow::Break(()),
                    (Some(n), _) => sender.send(n + 1).expect("open"),
                    (None, _) => {}
                }
                ControlFlow::Continue(())
            },
        );
        assert_eq!(described, [0, 1, 2]);
    }
}
