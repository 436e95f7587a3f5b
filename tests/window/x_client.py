"""What xdotool cannot do: properties, focus, minimising as a window manager does it, and dropping files (XDND)."""
import ctypes
import time

Window = Atom = Time = ctypes.c_ulong
STRING = 31  # atoms that every server has
ATOM = 4
RESOURCE_MANAGER = 23
SELECTION_REQUEST = 30
SELECTION_NOTIFY = 31
CLIENT_MESSAGE = 33
ICONIC_STATE, NORMAL_STATE = 3, 1
XDND_VERSION = 5


class ClientMessage(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", Window), ("message_type", Atom), ("format", ctypes.c_int),
                ("data", ctypes.c_long * 5)]  # fmt: skip


class SelectionRequest(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("owner", Window), ("requestor", Window), ("selection", Atom),
                ("target", Atom), ("property", Atom), ("time", Time)]  # fmt: skip


class Selection(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("requestor", Window), ("selection", Atom), ("target", Atom),
                ("property", Atom), ("time", Time)]  # fmt: skip


class Event(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("client", ClientMessage), ("request", SelectionRequest),
                ("selection", Selection), ("pad", ctypes.c_long * 24)]  # fmt: skip


def _library():
    x = ctypes.CDLL("libX11.so.6")
    pointer, number, text = ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p
    for name, result, arguments in (
        ("XOpenDisplay", pointer, [text]),
        ("XCloseDisplay", number, [pointer]),
        ("XDefaultRootWindow", Window, [pointer]),
        ("XInternAtom", Atom, [pointer, text, number]),
        ("XChangeProperty", number, [pointer, Window, Atom, Atom, number, number, pointer, number]),
        ("XCreateSimpleWindow", Window,
         [pointer, Window, number, number, ctypes.c_uint, ctypes.c_uint, ctypes.c_uint, ctypes.c_ulong, ctypes.c_ulong]),
        ("XSetSelectionOwner", number, [pointer, Atom, Window, Time]),
        ("XSetInputFocus", number, [pointer, Window, number, Time]),
        ("XMapWindow", number, [pointer, Window]),
        ("XUnmapWindow", number, [pointer, Window]),
        ("XSendEvent", number, [pointer, Window, number, ctypes.c_long, pointer]),
        ("XPending", number, [pointer]),
        ("XNextEvent", number, [pointer, pointer]),
        ("XSync", number, [pointer, number]),
    ):  # fmt: skip
        function = getattr(x, name)
        function.restype, function.argtypes = result, arguments
    return x


class XClient:
    """One connection to the server `name`; gone when it is closed."""

    def __init__(self, name):
        self.x = _library()
        self.display = self.x.XOpenDisplay(name.encode())
        assert self.display, name
        self.root = self.x.XDefaultRootWindow(self.display)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.x.XCloseDisplay(self.display)

    def atom(self, name):
        return self.x.XInternAtom(self.display, name.encode(), False)

    def set_text(self, window, atom, kind, text):
        data = text.encode()
        self.x.XChangeProperty(self.display, window, atom, kind, 8, 0, data, len(data))
        self.x.XSync(self.display, False)

    def set_resources(self, text):
        """What `xrdb` does: GLFW reads the scale of the screen there."""
        self.set_text(self.root, RESOURCE_MANAGER, STRING, text)

    def focus(self, window):
        """Gives the keyboard to `window`; 0 takes it from everybody."""
        revert_to_none = 0
        self.x.XSetInputFocus(self.display, window, revert_to_none, 0)
        self.x.XSync(self.display, False)

    def _set_state(self, window, state):
        wm_state = self.atom("WM_STATE")
        self.x.XChangeProperty(self.display, window, wm_state, wm_state, 32, 0, (ctypes.c_long * 2)(state, 0), 2)

    def minimise(self, window):
        self._set_state(window, ICONIC_STATE)
        self.x.XUnmapWindow(self.display, window)
        self.x.XSync(self.display, False)

    def restore(self, window):
        self.x.XMapWindow(self.display, window)
        self._set_state(window, NORMAL_STATE)
        self.x.XSync(self.display, False)

    def _tell(self, window, source, message, *data):
        event = Event()
        event.client = ClientMessage(CLIENT_MESSAGE, 0, True, self.display, window, self.atom(message), 32,
                                     (ctypes.c_long * 5)(source, *data))  # fmt: skip
        self.x.XSendEvent(self.display, window, False, 0, ctypes.byref(event))
        self.x.XSync(self.display, False)

    def drop(self, window, path, patience):
        """Drops the file `path` on `window`: the drag enters, moves, lets go, and hands over the path when asked."""
        source = self.x.XCreateSimpleWindow(self.display, self.root, 0, 0, 1, 1, 0, 0, 0)
        selection, uris = self.atom("XdndSelection"), self.atom("text/uri-list")
        self.x.XSetSelectionOwner(self.display, selection, source, 0)
        self._tell(window, source, "XdndEnter", XDND_VERSION << 24, uris, 0, 0)
        self._tell(window, source, "XdndPosition", 0, 200 << 16 | 200, 0, self.atom("XdndActionCopy"))
        self._tell(window, source, "XdndDrop", 0, 0, 0, 0)
        end = time.monotonic() + patience
        while time.monotonic() < end:
            if not self.x.XPending(self.display):
                time.sleep(0.01)
                continue
            event = Event()
            self.x.XNextEvent(self.display, ctypes.byref(event))
            if event.type == SELECTION_REQUEST:
                asked = event.request
                self.set_text(asked.requestor, asked.property, asked.target, path.resolve().as_uri() + "\r\n")
                answer = Event()
                answer.selection = Selection(SELECTION_NOTIFY, 0, True, self.display, asked.requestor, asked.selection,
                                             asked.target, asked.property, asked.time)  # fmt: skip
                self.x.XSendEvent(self.display, asked.requestor, False, 0, ctypes.byref(answer))
                self.x.XSync(self.display, False)
            if event.type == CLIENT_MESSAGE and event.client.message_type == self.atom("XdndFinished"):
                return
        raise AssertionError(f"nobody took {path}")
