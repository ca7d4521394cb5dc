//! Messages on a stream: headers, an empty line, and a JSON text of the length that the headers say.
//!
//! What is not a message gets an answer where that is possible, and the stream continues after it. Only a stream whose lengths
//! cannot be trusted any more has to end.

use serde_json::{Value, json};
use std::io::{BufRead, Read, Write};

/// Longest message that is read, in bytes: several times the largest job.
const LONGEST: usize = 256 << 20;

/// Longest line of a header.
const LONGEST_HEADER: u64 = 4096;

/// What came in.
#[derive(Debug, PartialEq)]
pub enum Incoming {
    /// A message that wants an answer.
    Request {
        /// By which the answer is known.
        id: Value,
        /// What is asked.
        method: String,
        /// About what.
        params: Value,
    },
    /// A message that wants none.
    Notification {
        /// What happened.
        method: String,
        params: Value,
    },
    /// The answer to a request of the server, which makes none that waits for one.
    Response,
    Malformed {
        /// The answer to it.
        refusal: Value,
        why: String,
    },
}

impl Incoming {
    /// The id of the request that this message takes back.
    #[must_use]
    pub fn takes_back(&self) -> Option<&Value> {
        match self {
            Self::Notification { method, params } if method == "$/cancelRequest" => params.get("id"),
            Self::Notification { .. } | Self::Request { .. } | Self::Response | Self::Malformed { .. } => {
                None
            }
        }
    }
}

/// Why no more messages can be read.
#[derive(Debug, PartialEq, Eq)]
pub enum Broken {
    /// The stream has ended between two messages.
    Ended,
    /// The start of the next message cannot be found.
    Astray(String),
}

/// Numbers of faults, by JSON-RPC and the protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The text is not JSON.
    Parse,
    /// The JSON is not a message.
    InvalidRequest,
    /// There is no such method.
    MethodNotFound,
    /// The method takes something else.
    InvalidParams,
    /// Something came before the client has introduced itself.
    NotInitialized,
    /// What was asked cannot be done.
    RequestFailed,
    /// The client does not want to know any more.
    RequestCancelled,
}

impl Fault {
    const fn number(self) -> i32 {
        match self {
            Self::Parse => -32700,
            Self::InvalidRequest => -32600,
            Self::MethodNotFound => -32601,
            Self::InvalidParams => -32602,
            Self::NotInitialized => -32002,
            Self::RequestFailed => -32803,
            Self::RequestCancelled => -32800,
        }
    }
}

/// The answer to a request.
#[must_use]
pub fn answer(id: &Value, result: &Value) -> Value {
    json!({ "jsonrpc": "2.0", "id": id, "result": result })
}

/// The answer to a request that cannot be met.
#[must_use]
pub fn refusal(id: &Value, fault: Fault, why: &str) -> Value {
    json!({ "jsonrpc": "2.0", "id": id, "error": { "code": fault.number(), "message": why } })
}

/// A message that wants no answer.
#[must_use]
pub fn notification(method: &str, params: &Value) -> Value {
    json!({ "jsonrpc": "2.0", "method": method, "params": params })
}

/// Reads the next message.
///
/// # Errors
/// When there is none, or when its end cannot be found.
pub fn read(stream: &mut impl BufRead) -> Result<Incoming, Broken> {
    let length = headers(stream)?;
    let mut body = vec![0; length];
    stream
        .read_exact(&mut body)
        .map_err(|error| Broken::Astray(format!("a message ends early: {error}")))?;
    Ok(match serde_json::from_slice(&body) {
        Ok(value) => message(value),
        Err(error) => malformed(&Value::Null, Fault::Parse, &error.to_string()),
    })
}

/// The length of the message whose headers these are.
fn headers(stream: &mut impl BufRead) -> Result<usize, Broken> {
    let mut length = None;
    let mut is_first = true;
    loop {
        let mut line = Vec::new();
        let read = stream
            .by_ref()
            .take(LONGEST_HEADER)
            .read_until(b'\n', &mut line)
            .map_err(|error| Broken::Astray(error.to_string()))?;
        if read == 0 && is_first {
            return Err(Broken::Ended);
        }
        is_first = false;
        if !line.ends_with(b"\n") {
            return Err(Broken::Astray("a header does not end".to_owned()));
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim();
        if line.is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':')
            && name.trim().eq_ignore_ascii_case("content-length")
        {
            length = value.trim().parse().ok().filter(|length| *length <= LONGEST);
        }
    }
    length.ok_or_else(|| Broken::Astray("headers without a length that can be read".to_owned()))
}

/// What a JSON value is.
fn message(value: Value) -> Incoming {
    let Value::Object(mut fields) = value else {
        return malformed(&Value::Null, Fault::InvalidRequest, "a message is an object");
    };
    let id = fields.remove("id");
    let params = fields.remove("params").unwrap_or(Value::Null);
    match (fields.remove("method"), id) {
        (Some(Value::String(method)), Some(id)) if id.is_string() || id.is_number() => {
            Incoming::Request { id, method, params }
        }
        (Some(Value::String(method)), None) => Incoming::Notification { method, params },
        (None, Some(_)) if fields.contains_key("result") || fields.contains_key("error") => {
            Incoming::Response
        }
        (_, id) => malformed(
            &id.unwrap_or(Value::Null),
            Fault::InvalidRequest,
            "a message has a method, and a request an id",
        ),
    }
}

fn malformed(id: &Value, fault: Fault, why: &str) -> Incoming {
    let id = if id.is_string() || id.is_number() {
        id
    } else {
        &Value::Null
    };
    Incoming::Malformed {
        refusal: refusal(id, fault, why),
        why: why.to_owned(),
    }
}

/// Writes a message.
///
/// # Errors
/// Those of the stream.
pub fn write(stream: &mut impl Write, message: &Value) -> std::io::Result<()> {
    let body = message.to_string();
    write!(stream, "Content-Length: {}\r\n\r\n{body}", body.len())?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn framed(body: &str) -> Vec<u8> {
        format!("Content-Length: {}\r\n\r\n{body}", body.len()).into_bytes()
    }

    #[test]
    fn what_is_written_can_be_read() {
        let mut stream = Vec::new();
        write(&mut stream, &notification("a/b", &json!({ "text": "ä🔪" }))).unwrap();
        write(&mut stream, &json!({ "jsonrpc": "2.0", "id": 3, "method": "c" })).unwrap();
        let mut stream = stream.as_slice();
        let first = Incoming::Notification {
            method: "a/b".to_owned(),
            params: json!({ "text": "ä🔪" }),
        };
        assert_eq!(read(&mut stream), Ok(first));
        let second = Incoming::Request {
            id: json!(3),
            method: "c".to_owned(),
            params: Value::Null,
        };
        assert_eq!(read(&mut stream), Ok(second));
        assert_eq!(read(&mut stream), Err(Broken::Ended));
    }

    #[test]
    fn what_is_not_a_message_is_answered_and_passed_over() {
        let mut stream = framed("{ nonsense");
        for body in ["[1, 2]", r#"{"id": {}, "method": "x"}"#, r#"{"id": 7}"#] {
            stream.extend(framed(body));
        }
        stream.extend(framed(r#"{"method": "exit"}"#));
        let mut stream = stream.as_slice();
        for (code, id) in [
            (-32700, json!(null)),
            (-32600, json!(null)),
            (-32600, json!(null)),
            (-32600, json!(7)),
        ] {
            let Ok(Incoming::Malformed { refusal: answer, .. }) = read(&mut stream) else {
                panic!("a message that is none");
            };
            assert_eq!((&answer["error"]["code"], &answer["id"]), (&json!(code), &id));
        }
        assert!(matches!(read(&mut stream), Ok(Incoming::Notification { .. })));
    }

    #[test]
    fn a_stream_without_lengths_ends() {
        for text in [
            "Content-Length: many\r\n\r\n{}",
            "Content-Length: 99999999999999\r\n\r\n{}",
            "Content-Length: 5\r\n\r\n{}",
            "\r\n\r\n",
            "GET / HTTP/1.1",
        ] {
            let read = read(&mut text.as_bytes());
            assert!(matches!(read, Err(Broken::Astray(_))), "{text:?}: {read:?}");
        }
    }
}
