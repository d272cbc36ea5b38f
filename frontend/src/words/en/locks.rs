//! What is said of asking for what somebody else is editing.

sentences! {
    ask_no_more: "Never mind";
    last_moment: "It is handed over in ten seconds. Save what you have; what you wrote stays here.";
}
