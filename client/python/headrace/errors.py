"""Exceptions: one class per error name of the protocol (`proto/README.md`, "Errors"), all derived from `Error`.

>>> ObjectNotFound('there is no "pannel"', path="params.name", hint='did you mean "panel"?').retryable
False
"""

from __future__ import annotations


class Error(Exception):
    """What the server refused, or what went wrong on the way to it.

    Attributes
    ----------
    name : str
        Stable name of the error, also where this client has no class for it (a later server's).
    message : str
        What happened.
    path : str
        Which member of the request is meant, such as ``params.until.time``; "" when none is.
    hint : str
        The remedy; "" when none is known.
    retryable : bool
        True: the same request may succeed later.
    """

    name: str = ""

    def __init__(self, message: str, *, path: str = "", hint: str = "", retryable: bool = False) -> None:
        super().__init__(message)
        self.message, self.path, self.hint, self.retryable = message, path, hint, retryable

    def __str__(self) -> str:
        place = f" ({self.path})" if self.path else ""
        remedy = f" [{self.hint}]" if self.hint else ""
        return f"{self.message}{place}{remedy}"


# Of requests.


class ParseError(Error):
    """Text that is not JSON, or a frame or a file that cannot be parsed."""

    name = "parse_error"


class InvalidRequest(Error):
    """JSON, but no JSON-RPC 2.0 request."""

    name = "invalid_request"


class MethodNotFound(Error):
    """The server knows no such method."""

    name = "method_not_found"


class InvalidParams(Error):
    """A parameter of a method has the wrong type, is missing, unknown or out of range."""

    name = "invalid_params"


class InternalError(Error):
    """A mistake of the server's own."""

    name = "internal_error"


class JsonTooDeep(Error):
    """JSON is nested too deeply."""

    name = "json_too_deep"


class DuplicateKey(Error):
    """A JSON object has a key twice."""

    name = "duplicate_key"


class MessageTooLarge(Error):
    """A request is longer than the server takes."""

    name = "message_too_large"


# Of states.


class WrongState(Error):
    """The server's state does not allow this now."""

    name = "wrong_state"


class WrongSocket(Error):
    """The method belongs to another socket."""

    name = "wrong_socket"


class Busy(Error):
    """A scene is being loaded; try again later."""

    name = "busy"


# Of names and documents.


class SceneNotFound(Error):
    """There is no such preset."""

    name = "scene_not_found"


class SceneInvalid(Error):
    """The scene document is well-formed and makes no sense."""

    name = "scene_invalid"


class ObjectNotFound(Error):
    """There is no such object."""

    name = "object_not_found"


class ObjectExists(Error):
    """There is an object of that name already."""

    name = "object_exists"


class ParameterNotFound(Error):
    """The model has no such parameter."""

    name = "parameter_not_found"


class JobNotFound(Error):
    """There is no such job."""

    name = "job_not_found"


class StreamNotFound(Error):
    """There is no such stream (any more)."""

    name = "stream_not_found"


class RecordingNotFound(Error):
    """There is no such recording."""

    name = "recording_not_found"


class ParticleNotFound(Error):
    """There is no such particle."""

    name = "particle_not_found"


class ProbeNotFound(Error):
    """There is no such probe, or it has no such value."""

    name = "probe_not_found"


class ProbeExists(Error):
    """There is a probe of that name already."""

    name = "probe_exists"


class LimitExceeded(Error):
    """More than the server allows."""

    name = "limit_exceeded"


class FileError(Error):
    """A file cannot be read or written."""

    name = "file_error"


# Of runs.


class Cancelled(Error):
    """The run was cancelled before its end was reached."""

    name = "cancelled"


class TimedOut(Error):
    """A time-out passed: of the run in simulated time, or of the wait for it in wall time."""

    name = "timed_out"


class Faulted(Error):
    """The run stopped before garbage spread; `hint` has the remedy."""

    name = "faulted"


class ShuttingDown(Error):
    """The server is ending."""

    name = "shutting_down"


# Of the client's own.


class ConnectionFailed(Error):
    """No server answers, or it has vanished."""

    name = "connection_failed"


class ProtocolMismatch(Error):
    """The server speaks another protocol number."""

    name = "protocol_mismatch"


class Usage(Error):
    """An argument makes no sense, which the client tells without asking the server."""

    name = "usage"
