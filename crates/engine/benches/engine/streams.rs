//! The graphs with typed closures over shared streams, as a library of streams would run them.

use crate::graphs::Way;
use crate::hand::{SIZES, YAWS};
use std::cell::{Cell, RefCell};
use std::hint::black_box;
use std::rc::Rc;

type Listeners<T> = Vec<Box<dyn FnMut(T)>>;

/// A shared stream: whoever listens hears every value, in order.
struct Stream<T>(Rc<RefCell<Listeners<T>>>);

impl<T> Clone for Stream<T> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<T: Copy + 'static> Stream<T> {
    fn new() -> Self {
        Self(Rc::default())
    }

    fn hear(&self, listener: impl FnMut(T) + 'static) {
        self.0.borrow_mut().push(Box::new(listener));
    }

    fn put(&self, value: T) {
        for listener in self.0.borrow_mut().iter_mut() {
            listener(value);
        }
    }

    /// The stream of what `make` gives.
    fn to<U: Copy + 'static>(&self, make: impl Fn(T) -> Option<U> + 'static) -> Stream<U> {
        let made = Stream::new();
        let output = made.clone();
        self.hear(move |value| {
            if let Some(value) = make(value) {
                output.put(value);
            }
        });
        made
    }

    fn act(&self) {
        self.hear(|value| _ = black_box(value));
    }
}

/// Ten maps in a row.
pub(crate) fn chain() -> Way {
    let sensor = Stream::<i64>::new();
    (0..10).fold(sensor.clone(), |stream, _| stream.to(|x| x.checked_add(1)));
    Box::new(move |events| (0..events as i64).for_each(|x| sensor.put(black_box(x))))
}

/// A hundred filters.
pub(crate) fn fanout() -> Way {
    let sensor = Stream::<i64>::new();
    for k in 0..100 {
        sensor.to(move |x| (x > k).then_some(x)).act();
    }
    Box::new(move |events| (0..events as i64).for_each(|at| sensor.put(black_box(at % 64 * 100 / 64))))
}

/// A hundred sensors into one map.
pub(crate) fn merge() -> Way {
    let merged = Stream::<i64>::new();
    let sensors = [(); 100].map(|()| Stream::<i64>::new());
    for sensor in &sensors {
        let merged = merged.clone();
        sensor.hear(move |x| merged.put(x));
    }
    merged.to(|x| x.checked_add(1)).act();
    Box::new(move |events| {
        for (x, sensor) in (0..events as i64).zip(sensors.iter().cycle()) {
            sensor.put(black_box(x));
        }
    })
}

#[derive(Clone, Copy)]
struct Ball {
    x: f64,
    size: f64,
}

#[derive(Clone, Copy)]
struct Stamped {
    value: f64,
    at: i64,
}

/// Figure 4.20 of the thesis.
pub(crate) fn tracking() -> Way {
    let now = Rc::new(Cell::new(0_i64));
    let (ball, yaw) = (Stream::<Ball>::new(), Stream::<f64>::new());
    let distance = ball.to(|ball| Some(6.0 / ball.size));
    distance.to(|distance| (distance > 2.0).then_some(distance)).act();
    distance.to(|distance| (distance > 1.0 && distance <= 2.0).then_some(distance)).act();
    let close = ball.to(|ball| Some((ball.x, 6.0 / ball.size))).to(|xd| (xd.1 <= 1.0).then_some(xd));
    let clocks = [now.clone(), now.clone()];
    let [yaw_at, ball_at] = [yaw.clone(), close.to(|close| Some(close.0))];
    let [clock, other] = clocks;
    let yaw_at = yaw_at.to(move |value| Some(Stamped { value, at: clock.get() }));
    let ball_at = ball_at.to(move |value| Some(Stamped { value, at: other.get() }));
    let recent = combined(&yaw_at, &ball_at).to(|both| (both.at < 1000).then_some(both));
    recent.to(|both| Some(both.value)).to(|angle| Some(if angle < 0.0 { "left" } else { "right" })).act();
    Box::new(move |events| {
        for at in 0..events as i64 {
            now.set(at);
            let which = usize::try_from(at / 2 % 3).unwrap();
            if at % 2 == 0 {
                ball.put(black_box(Ball { x: -0.3, size: SIZES[which] }));
            } else {
                yaw.put(black_box(YAWS[which]));
            }
        }
    })
}

fn combined(yaw: &Stream<Stamped>, ball: &Stream<Stamped>) -> Stream<Stamped> {
    let made = Stream::new();
    let latest = Rc::new(Cell::new((None, None)));
    let listener = |store: fn(&mut (Option<Stamped>, Option<Stamped>), Stamped)| {
        let (latest, made) = (latest.clone(), made.clone());
        move |value| {
            let mut known = latest.get();
            store(&mut known, value);
            latest.set(known);
            if let (Some(yaw), Some(ball)) = known {
                made.put(Stamped { value: yaw.value + ball.value, at: yaw.at - ball.at });
            }
        }
    };
    yaw.hear(listener(|known, value| known.0 = Some(value)));
    ball.hear(listener(|known, value| known.1 = Some(value)));
    made
}
