//! Which key does what. The panel shows the same table.

use welkin_controls::{Keys, PRESETS};
use welkin_runtime::Method;
use winit::event::ElementState;
use winit::keyboard::{KeyCode, PhysicalKey};

use super::state::{State, Wish};

/// For the panel: keys, and what they do.
pub const HELP: [(&str, &str); 13] = [
    ("drag, arrows", "look around"),
    ("wheel", "zoom; in flight, speed"),
    ("F", "fly: W A S D, E up, Q down, Shift faster"),
    ("1 … 5", "method"),
    ("F1 … F6", "weather"),
    ("Space", "time stands or goes on"),
    ("H", "hide or show the panel"),
    ("P", "save a picture"),
    ("Ctrl+S, Ctrl+O", "save, load the settings"),
    ("C", "copy as a command line"),
    ("F11", "full screen"),
    ("Ctrl+R", "open the GPU anew"),
    ("Tab", "to the next control"),
];

/// A key went down or up while no text field wanted it.
pub fn key(
    state: &mut State,
    key: PhysicalKey,
    element: ElementState,
    is_repeat: bool,
    ctrl: bool,
) {
    let PhysicalKey::Code(code) = key else {
        return;
    };
    let is_down = element == ElementState::Pressed;
    if is_down && ctrl {
        match code {
            KeyCode::KeyS => state.wishes.push(Wish::SaveSettings),
            KeyCode::KeyO => state.wishes.push(Wish::LoadSettings),
            KeyCode::KeyR => state.wishes.push(Wish::RestartGraphics),
            _ => {}
        }
        return;
    }
    if hold(&mut state.keys, code, is_down) || !is_down || is_repeat {
        return;
    }
    match code {
        KeyCode::KeyF => state.pilot.flying = !state.pilot.flying,
        KeyCode::Space => state.playing = !state.playing,
        KeyCode::KeyH => state.panel_shown = !state.panel_shown,
        KeyCode::KeyP => state.wishes.push(Wish::SavePicture),
        KeyCode::KeyC => state.wishes.push(Wish::CopyCommand),
        KeyCode::F11 => state.wishes.push(Wish::ToggleFullscreen),
        _ => choose(state, code),
    }
}

/// A method by its number, a weather by its function key.
fn choose(state: &mut State, code: KeyCode) {
    const DIGITS: [KeyCode; 5] = [
        KeyCode::Digit1,
        KeyCode::Digit2,
        KeyCode::Digit3,
        KeyCode::Digit4,
        KeyCode::Digit5,
    ];
    const FUNCTIONS: [KeyCode; 6] = [
        KeyCode::F1,
        KeyCode::F2,
        KeyCode::F3,
        KeyCode::F4,
        KeyCode::F5,
        KeyCode::F6,
    ];
    if let Some(index) = DIGITS.iter().position(|digit| *digit == code) {
        state.settings.params.method = Method::ALL[index];
    }
    if let Some(index) = FUNCTIONS.iter().position(|function| *function == code) {
        state.begin_weather(&PRESETS[index]);
    }
}

/// Keys that act as long as they are held; whether this is one.
fn hold(keys: &mut Keys, code: KeyCode, is_down: bool) -> bool {
    let (axis, direction) = match code {
        KeyCode::ArrowRight => (&mut keys.turn_right, 1.0),
        KeyCode::ArrowLeft => (&mut keys.turn_right, -1.0),
        KeyCode::ArrowUp => (&mut keys.turn_up, 1.0),
        KeyCode::ArrowDown => (&mut keys.turn_up, -1.0),
        KeyCode::KeyW => (&mut keys.forward, 1.0),
        KeyCode::KeyS => (&mut keys.forward, -1.0),
        KeyCode::KeyD => (&mut keys.right, 1.0),
        KeyCode::KeyA => (&mut keys.right, -1.0),
        KeyCode::KeyE => (&mut keys.up, 1.0),
        KeyCode::KeyQ => (&mut keys.up, -1.0),
        KeyCode::ShiftLeft | KeyCode::ShiftRight => {
            keys.haste = is_down;
            return true;
        }
        _ => return false,
    };
    if is_down {
        *axis = direction;
    } else if *axis == direction {
        *axis = 0.0;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_key_acts_until_it_is_let_go() {
        let mut keys = Keys::default();
        assert!(hold(&mut keys, KeyCode::KeyW, true));
        assert!(hold(&mut keys, KeyCode::KeyA, true));
        assert_eq!((keys.forward, keys.right), (1.0, -1.0));
        // The other direction takes over, and letting the first go does not stop it.
        hold(&mut keys, KeyCode::KeyD, true);
        hold(&mut keys, KeyCode::KeyA, false);
        assert_eq!(keys.right, 1.0);
        hold(&mut keys, KeyCode::KeyD, false);
        hold(&mut keys, KeyCode::KeyW, false);
        assert_eq!(keys, Keys::default());
        assert!(!hold(&mut keys, KeyCode::KeyX, true));
    }
}
