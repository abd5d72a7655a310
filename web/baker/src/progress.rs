//! Progress to JavaScript. The baker may tell it from any thread and JavaScript has one, so the function waits beside it.

use std::cell::RefCell;
use std::ops::ControlFlow;

use wasm_bindgen::prelude::*;
use welkin_baker::Progress;

thread_local! {
    static TOLD: RefCell<Option<js_sys::Function>> = const { RefCell::new(None) };
}

/// What tells `function` each step. To stop a bake, its worker is ended.
pub(crate) fn told_to(function: js_sys::Function) -> impl Fn(Progress) -> ControlFlow<()> + Sync {
    TOLD.with_borrow_mut(|told| *told = Some(function));
    |progress| {
        TOLD.with_borrow(|told| {
            let Progress {
                step,
                done,
                total,
                notice,
            } = progress;
            let notice = notice.map_or(JsValue::UNDEFINED, |notice| notice.to_string().into());
            let all = js_sys::Array::of4(&step.into(), &done.into(), &total.into(), &notice);
            if let Some(told) = told {
                // What it throws is its own matter.
                drop(told.apply(&JsValue::NULL, &all));
            }
        });
        ControlFlow::Continue(())
    }
}
