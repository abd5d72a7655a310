//! A file manager's side of drag and drop: the protocol XDND, version 5 (freedesktop.org, "Drag-and-Drop Protocol for the X Window System").

use std::path::Path;

use x11rb::COPY_DEPTH_FROM_PARENT;
use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    Atom, AtomEnum, ClientMessageEvent, ConnectionExt, CreateWindowAux, EventMask, PropMode,
    SELECTION_NOTIFY_EVENT, SelectionNotifyEvent, SelectionRequestEvent, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

use super::SIZE_PX;

const VERSION: u32 = 5;

/// Drops a file on a window and waits until the window has taken it.
pub fn file(display: &str, target: u32, file: &Path) {
    let (connection, screen) = x11rb::connect(Some(display)).unwrap();
    let root = connection.setup().roots[screen].root;
    let source = connection.generate_id().unwrap();
    connection
        .create_window(
            COPY_DEPTH_FROM_PARENT,
            source,
            root,
            0,
            0,
            1,
            1,
            0,
            WindowClass::INPUT_OUTPUT,
            0,
            &CreateWindowAux::new(),
        )
        .unwrap();
    let hand = Hand {
        connection,
        source,
        target,
        uri: format!("file://{}\r\n", encoded(file)),
    };
    hand.drop();
}

struct Hand {
    connection: RustConnection,
    source: u32,
    target: u32,
    uri: String,
}

impl Hand {
    fn drop(&self) {
        let [selection, list, copy] =
            ["XdndSelection", "text/uri-list", "XdndActionCopy"].map(|name| self.atom(name));
        self.connection
            .set_selection_owner(self.source, selection, x11rb::CURRENT_TIME)
            .unwrap();
        self.tell("XdndEnter", [VERSION << 24, list, 0, 0]);
        let middle = ((SIZE_PX[0] * 3 / 4) << 16) | (SIZE_PX[1] / 2);
        self.tell("XdndPosition", [0, middle, x11rb::CURRENT_TIME, copy]);
        let (status, finished) = (self.atom("XdndStatus"), self.atom("XdndFinished"));
        loop {
            match self.connection.wait_for_event().unwrap() {
                Event::SelectionRequest(request) => self.give(&request),
                Event::ClientMessage(told) if told.type_ == status => {
                    assert_eq!(told.data.as_data32()[1] & 1, 1, "the window takes files");
                    self.tell("XdndDrop", [0, x11rb::CURRENT_TIME, 0, 0]);
                }
                Event::ClientMessage(told) if told.type_ == finished => return,
                _ => {}
            }
        }
    }

    fn tell(&self, message: &str, [a, b, c, d]: [u32; 4]) {
        let message = self.atom(message);
        let data = [self.source, a, b, c, d];
        let event = ClientMessageEvent::new(32, self.target, message, data);
        self.connection
            .send_event(false, self.target, EventMask::NO_EVENT, event)
            .unwrap();
        self.connection.flush().unwrap();
    }

    /// Gives the file's name to the window that asks for it.
    fn give(&self, request: &SelectionRequestEvent) {
        self.connection
            .change_property8(
                PropMode::REPLACE,
                request.requestor,
                request.property,
                request.target,
                self.uri.as_bytes(),
            )
            .unwrap();
        let done = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time: request.time,
            requestor: request.requestor,
            selection: request.selection,
            target: request.target,
            property: request.property,
        };
        self.connection
            .send_event(false, request.requestor, EventMask::NO_EVENT, done)
            .unwrap();
        self.connection.flush().unwrap();
    }

    fn atom(&self, name: &str) -> Atom {
        let cookie = self.connection.intern_atom(false, name.as_bytes());
        let atom = cookie.unwrap().reply().unwrap().atom;
        assert_ne!(atom, u32::from(AtomEnum::NONE));
        atom
    }
}

/// A path as a URI has it.
fn encoded(file: &Path) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/-_.~".contains(&byte);
    let text = file.to_str().unwrap();
    text.bytes()
        .map(|byte| match plain(byte) {
            true => char::from(byte).to_string(),
            false => format!("%{byte:02X}"),
        })
        .collect()
}
