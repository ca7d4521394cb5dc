//! Requests of a browser, as far as a page and its changes need them, and the heads of answers.
//!
//! A page on this machine is within reach of every site that the user visits: such a site can have its own name point to
//! 127.0.0.1 and ask under that name. So a request must name the very address that was printed ([RFC 9112], section 3.2).
//!
//! [RFC 9112]: https://www.rfc-editor.org/rfc/rfc9112

/// Most bytes of a request's head.
pub(super) const LONGEST_HEAD: usize = 8 << 10;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Asked {
    Page,
    /// To learn when the page is not of this version any more.
    Changes {
        version: String,
    },
}

/// A request that is answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Request {
    pub(super) asked: Asked,
    pub(super) extent: Extent,
}

/// How much of an answer is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// All of it (`GET`).
    Whole,
    /// Its head (`HEAD`).
    Head,
}

/// Why a request is not answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Refused {
    /// It is not an HTTP request.
    Malformed,
    /// It does not name this server.
    Stranger,
    /// There is nothing of that name.
    NotFound,
    /// It wants to do something else than read.
    Method,
    /// Its head is too long.
    TooLong,
    /// Its head does not end in time.
    Late,
    /// Too many others are being answered.
    Busy,
}

impl Refused {
    /// The status line.
    pub(super) const fn status(self) -> &'static str {
        match self {
            Self::Malformed => "400 Bad Request",
            Self::Stranger => "403 Forbidden",
            Self::NotFound => "404 Not Found",
            Self::Method => "405 Method Not Allowed",
            Self::Late => "408 Request Timeout",
            Self::TooLong => "431 Request Header Fields Too Large",
            Self::Busy => "503 Service Unavailable",
        }
    }
}

/// Reads the head of a request to the server at a port.
pub(super) fn read(head: &str, port: u16) -> Result<Request, Refused> {
    let mut lines = head.split("\r\n");
    let mut first = lines.next().unwrap_or_default().split(' ');
    let (Some(method), Some(target), Some("HTTP/1.1" | "HTTP/1.0"), None) =
        (first.next(), first.next(), first.next(), first.next())
    else {
        return Err(Refused::Malformed);
    };
    let hosts: Vec<&str> = lines.filter_map(host).collect();
    match hosts.as_slice() {
        [host] if is_ours(host, port) => {}
        [_] => return Err(Refused::Stranger),
        _ => return Err(Refused::Malformed),
    }
    let extent = match method {
        "GET" => Extent::Whole,
        "HEAD" => Extent::Head,
        _ => return Err(Refused::Method),
    };
    let asked = match target.split_once('?') {
        None if target == "/" => Asked::Page,
        Some(("/changes", query)) => Asked::Changes {
            version: query.to_owned(),
        },
        Some(_) | None => return Err(Refused::NotFound),
    };
    Ok(Request { asked, extent })
}

/// The value of a line `Host: ...`.
fn host(line: &str) -> Option<&str> {
    let (name, value) = line.split_once(':')?;
    name.eq_ignore_ascii_case("host").then(|| value.trim())
}

fn is_ours(host: &str, port: u16) -> bool {
    ["127.0.0.1", "localhost"].iter().any(|name| {
        host.eq_ignore_ascii_case(&format!("{name}:{port}"))
            || (port == 80 && host.eq_ignore_ascii_case(name))
    })
}

/// The head of an answer. Nothing of it is kept by the browser, shown inside of other pages, or taken for another kind.
pub(super) fn head(status: &str, kind: &str, length: Option<usize>) -> String {
    let length = length.map_or(String::new(), |length| format!("Content-Length: {length}\r\n"));
    format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\n{length}Cache-Control: no-store\r\n\
         Content-Security-Policy: frame-ancestors 'none'\r\nCross-Origin-Resource-Policy: same-origin\r\n\
         Referrer-Policy: no-referrer\r\nX-Content-Type-Options: nosniff\r\nAllow: GET, HEAD\r\nConnection: close\r\n\r\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(first: &str, more: &str) -> Result<Request, Refused> {
        read(&format!("{first}\r\n{more}\r\n\r\n"), 8228)
    }

    #[test]
    fn only_what_this_server_has_is_read() {
        let ours = "Host: 127.0.0.1:8228";
        let whole = |asked| {
            Ok(Request {
                asked,
                extent: Extent::Whole,
            })
        };
        assert_eq!(asked("GET / HTTP/1.1", ours), whole(Asked::Page));
        assert_eq!(
            asked("GET / HTTP/1.1", "Accept: */*\r\nhOST:  LocalHost:8228 "),
            whole(Asked::Page)
        );
        let version = "7-3".to_owned();
        assert_eq!(
            asked("GET /changes?7-3 HTTP/1.1", ours),
            whole(Asked::Changes { version })
        );
        assert_eq!(
            asked("HEAD / HTTP/1.0", ours),
            Ok(Request {
                asked: Asked::Page,
                extent: Extent::Head
            })
        );
        for (first, more, refused) in [
            ("GET / HTTP/1.1", "Host: evil.example", Refused::Stranger),
            ("GET / HTTP/1.1", "Host: evil.example:8228", Refused::Stranger),
            ("GET / HTTP/1.1", "Host: 127.0.0.1", Refused::Stranger),
            (
                "GET / HTTP/1.1",
                "Host: 127.0.0.1:8228.evil.example",
                Refused::Stranger,
            ),
            ("POST / HTTP/1.1", "Host: evil.example", Refused::Stranger),
            ("GET / HTTP/1.1", "Accept: */*", Refused::Malformed),
            (
                "GET / HTTP/1.1",
                "Host: 127.0.0.1:8228\r\nHost: evil.example",
                Refused::Malformed,
            ),
            ("GET  / HTTP/1.1", ours, Refused::Malformed),
            ("GET / HTTP/2", ours, Refused::Malformed),
            ("", ours, Refused::Malformed),
            ("POST / HTTP/1.1", ours, Refused::Method),
            ("GET /../etc/passwd HTTP/1.1", ours, Refused::NotFound),
            ("GET http://127.0.0.1:8228/ HTTP/1.1", ours, Refused::NotFound),
        ] {
            assert_eq!(asked(first, more), Err(refused), "{first} {more}");
        }
    }
}
