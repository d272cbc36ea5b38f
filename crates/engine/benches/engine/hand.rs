//! The graphs by hand: typed closures that call each other directly, the limit.

use crate::graphs::Way;
use std::cell::Cell;
use std::hint::black_box;
use std::rc::Rc;

/// The sizes of the ball that are seen: far, middle, close.
pub(crate) const SIZES: [f64; 3] = [2.0, 4.0, 8.0];
/// The angles of the head in between.
pub(crate) const YAWS: [f64; 3] = [0.1, 0.5, -0.2];

type Next<T> = Box<dyn FnMut(T)>;

/// Ten maps in a row.
pub(crate) fn chain() -> Way {
    let mut next: Next<i64> = Box::new(|x| _ = black_box(x));
    for _ in 0..10 {
        let mut after = next;
        next = Box::new(move |x| {
            if let Some(x) = x.checked_add(1) {
                after(x);
            }
        });
    }
    Box::new(move |events| (0..events as i64).for_each(|x| next(black_box(x))))
}

/// A hundred filters.
pub(crate) fn fanout() -> Way {
    let mut filters: Vec<Next<i64>> = Vec::new();
    for k in 0..100 {
        let mut act: Next<i64> = Box::new(|x| _ = black_box(x));
        filters.push(Box::new(move |x| {
            if x > black_box(k) {
                act(x);
            }
        }));
    }
    Box::new(move |events| {
        for at in 0..events as i64 {
            let x = black_box(at % 64 * 100 / 64);
            filters.iter_mut().for_each(|filter| filter(x));
        }
    })
}

/// A hundred sensors into one map.
pub(crate) fn merge() -> Way {
    let mut act: Next<i64> = Box::new(|x| _ = black_box(x));
    let mut map: Next<i64> = Box::new(move |x| {
        if let Some(x) = x.checked_add(1) {
            act(x);
        }
    });
    Box::new(move |events| (0..events as i64).for_each(|x| map(black_box(x % 100))))
}

struct Seen {
    value: f64,
    at: i64,
}

/// Figure 4.20 of the thesis.
pub(crate) fn tracking() -> Way {
    let (head, ball) = (Rc::new(Cell::new(None)), Rc::new(Cell::new(None)));
    let (mut on_yaw, mut on_x) = (combined(head.clone(), ball.clone()), combined(head.clone(), ball.clone()));
    let mut act: Next<f64> = Box::new(|x| _ = black_box(x));
    let mut on_ball: Box<dyn FnMut(f64, f64, i64)> = Box::new(move |x, size, now| {
        let distance = 6.0 / size;
        if distance > 2.0 {
            act(distance);
        }
        if distance > 1.0 && distance <= 2.0 {
            act(distance);
        }
        if distance <= 1.0 {
            ball.set(Some(Rc::new(Seen { value: x, at: now })));
            on_x(());
        }
    });
    Box::new(move |events| {
        for now in 0..events as i64 {
            let which = usize::try_from(now / 2 % 3).unwrap();
            if now % 2 == 0 {
                on_ball(black_box(-0.3), black_box(SIZES[which]), now);
            } else {
                head.set(Some(Rc::new(Seen { value: black_box(YAWS[which]), at: now })));
                on_yaw(());
            }
        }
    })
}

type Latest = Rc<Cell<Option<Rc<Seen>>>>;

fn combined(head: Latest, ball: Latest) -> Next<()> {
    let mut act: Next<&'static str> = Box::new(|arm| _ = black_box(arm));
    Box::new(move |()| {
        let (yaw, x) = (head.take(), ball.take());
        if let (Some(yaw), Some(x)) = (&yaw, &x)
            && yaw.at - x.at < 1000
        {
            act(if yaw.value + x.value < 0.0 { "left" } else { "right" });
        }
        head.set(yaw);
        ball.set(x);
    })
}
