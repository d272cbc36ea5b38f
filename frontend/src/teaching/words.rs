//! Sentences that only learning says.

pub(crate) use crate::words::*;

sentences! {
    exercise_put_away: "The task is put away. “Show the task” in the list of commands (Ctrl K) brings it back.";
    fold_goal: "Hide the goal";
    show_goal: "Show the goal";
    put_goal_away: "Put the task away";
    rehearsing: "Trying it …";
    answer_first: "Choose an answer to each question first.";
    goal_of_empty: "There is nothing in the program yet.";
    goal_too_large: "This program is too large to be tried here. Start it on the simulated robot instead.";
    goal_too_long: "This took too long to try. Start it on the simulated robot to see what keeps it busy.";
    // The tour
    tour: "Tour";
    leave_tour: "Leave the tour";
    tour_skip: "Skip";
    tour_done: "Done";
    tour_program: "You will teach a simulated robot to follow a ball that comes close. Begin with an empty program: press the button, give it a name and create it.";
    tour_sense: "A program begins with a sense. Press Red ball: it tells where the robot sees one.";
    tour_helper: "Under the ball stands what can come next. Press “Distance in cm”: it makes a number of centimetres out of what is seen.";
    tour_test: "Now keep only the ball that is close. Press filter, write 40 behind “distance <” and press Enter.";
    tour_action: "Only close balls come through. Lead them to an action: press Tracker, and the head follows them.";
    tour_number: "Every number can be changed. Press the filter on its line, and make 60 of the 40.";
    tour_start: "The program is ready. Press Start; it runs on the simulated robot.";
    tour_ball: "Drag the red ball in the room, nearer and farther. The head follows it while it is close, and the numbers flow on the lines.";
    tour_stop: "Stop always stands here, and always works. Press it: the robot holds still.";
    tour_end: "That was all it takes: a sense, a connector, an action. The tasks in the library are a good way to go on.";
}

/// The heading of the goal: "Task: Brighter when nearer".
pub(crate) fn exercise_called(name: &str) -> String {
    say!(exercise_called: "Task: {name}", name)
}

pub(crate) fn goal_reached(says: &str) -> String {
    say!(goal_reached: "Reached. {says}", says)
}

/// Says what is not reached, and what went wrong in a procedure.
pub(crate) fn goal_missed_by(says: &str, why: &str) -> String {
    say!(goal_missed_by: "{says} Something fails on the way: {why}", says, why)
}

pub(crate) fn goal_cannot_run(why: &str) -> String {
    say!(goal_cannot_run: "It cannot run yet: {why}.", why)
}

/// Says how far somebody is: "Step 2 of 9".
pub(crate) fn tour_step(at: usize, of: usize) -> String {
    say!(tour_step: "Step {at} of {of}", at, of)
}
