#!/usr/bin/python3
"""An http and an ftp server on loopback that serve a folder and misbehave as their paths ask for.

Prints the two ports and serves until its standard input is closed. Paths (http; ftp has the first two):
  /files/NAME     the file, with ranges and an ETag
  /broken/NAME    the connection breaks after 1000 bytes, every time
  /stuck/NAME     the connection breaks before the first byte, every time
  /flaky/NAME     status 503 twice, then the file
  /whole/NAME     the file, without ranges or ETag
  /silent/NAME    half of the file without a length, then the connection ends; from then on all of it, without one
  /swap/NAME      half of the file, then the connection breaks; from then on NAME.new
  /shifted/NAME   the file, but to a range always another one
  /moved/NAME     redirection to /files/NAME
  /page/NAME      a page of HTML, said to be the file
  /drive?id=NAME  a page that asks for a confirmation, as Google Drive has it
  /quota?id=NAME  a page that says no
  /endless/…      spaces, until the client goes
  /dspace/…       the REST interface of a DSpace 7 repository: one item, `item`, with the folder's files, two a page
"""

import contextlib
import hashlib
import http.server
import json
import os
import socketserver
import sys
import threading
import urllib.parse

FOLDER = sys.argv[1]
CHUNK = 1000
seen = {}


def count(key):
    seen[key] = seen.get(key, 0) + 1
    return seen[key]


def read(name):
    with open(os.path.join(FOLDER, os.path.basename(name)), "rb") as file:
        return file.read()


class Http(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def do_GET(self):
        self.close_connection = True
        url = urllib.parse.urlparse(self.path)
        way, _, name = url.path[1:].partition("/")
        query = dict(urllib.parse.parse_qsl(url.query))
        try:
            getattr(self, "send_" + way)(name or query.get("id", ""), query)
        except (AttributeError, FileNotFoundError):
            self.head(404, 0)

    def head(self, status, size, **headers):
        self.send_response(status)
        self.send_header("Content-Length", str(size))
        self.send_header("Connection", "close")
        for key, value in headers.items():
            self.send_header(key.replace("_", "-"), value)
        self.end_headers()

    def send_part(self, data, limit=None):
        etag = '"' + hashlib.md5(data).hexdigest() + '"'
        begin = 0
        if "Range" in self.headers and self.headers.get("If-Range", etag) == etag:
            begin = int(self.headers["Range"][6:].rstrip("-"))
            if begin >= len(data):
                self.head(416, 0, Content_Range=f"bytes */{len(data)}")
                return
        rest = data[begin:]
        extra = {"Content-Range": f"bytes {begin}-{len(data) - 1}/{len(data)}"} if begin else {}
        self.head(206 if begin else 200, len(rest), ETag=etag, **extra)
        self.wfile.write(rest[:limit])

    def send_files(self, name, _):
        self.send_part(read(name))

    def send_broken(self, name, _):
        self.send_part(read(name), CHUNK)

    def send_stuck(self, name, _):
        self.send_part(read(name), 0)

    def send_flaky(self, name, _):
        if count("flaky" + name) <= 2:
            self.head(503, 0)
        else:
            self.send_part(read(name))

    def send_whole(self, name, _):
        data = read(name)
        limit = len(data) // 2 if count("whole" + name) == 1 else None
        self.head(200, len(data))
        self.wfile.write(data[:limit])

    def send_silent(self, name, _):
        data = read(name)
        self.send_response(200)
        self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(data[:len(data) // 2 if count("silent" + name) == 1 else None])

    def send_shifted(self, name, _):
        data = read(name)
        if "Range" not in self.headers:
            self.send_part(data)
            return
        self.head(206, 1000, Content_Range=f"bytes 1000-1999/{len(data)}")
        self.wfile.write(data[1000:2000])

    def send_swap(self, name, _):
        if count("swap" + name) == 1:
            data = read(name)
            self.send_part(data, len(data) // 2)
        else:
            self.send_part(read(name + ".new"))

    def send_moved(self, name, _):
        self.head(302, 0, Location="/files/" + name)

    def send_html(self, text, **headers):
        data = text.encode()
        self.head(200, len(data), **headers)
        self.wfile.write(data)

    def send_page(self, _, __):
        self.send_html("<!DOCTYPE html><html><title>Log in</title></html>",
                       Content_Type="application/zip")

    def send_drive(self, name, query):
        if query.get("confirm") == "t" and query.get("uuid") == "a b&c" and "warned=1" in self.headers.get("Cookie", ""):
            self.send_part(read(name), CHUNK)
            return
        self.send_html('<html><title>Virus scan warning</title><form id="download-form" action="/drive?x=1&amp;y=2" '
                       f'method="get"><input type="hidden" name="id" value="{name}">'
                       '<input type="hidden" name="confirm" value="t">'
                       '<input type="hidden" name="uuid" value="a b&amp;c"></form></html>',
                       Content_Type="text/html; charset=utf-8", Set_Cookie="warned=1")

    def send_quota(self, _, __):
        self.send_html("<html><title>Quota exceeded</title></html>", Content_Type="text/html")

    def send_endless(self, _, __):
        self.send_response(200)
        self.send_header("Connection", "close")
        self.end_headers()
        with contextlib.suppress(ConnectionError):
            while True:
                self.wfile.write(b" " * 65536)

    def send_json(self, value):
        data = json.dumps(value).encode()
        self.head(200, len(data), Content_Type="application/hal+json;charset=UTF-8")
        self.wfile.write(data)

    def send_dspace(self, name, query):
        root = f"http://127.0.0.1:{self.server.server_address[1]}/dspace"
        if name == "core/items/item/bundles":
            bundles = [{"uuid": "small", "name": "THUMBNAIL", "type": "bundle"}, {"uuid": "files", "name": "ORIGINAL", "type": "bundle"}]
            self.send_json({"_embedded": {"bundles": bundles}, "page": {"size": 20, "totalElements": 2, "totalPages": 1, "number": 0}})
        elif name == "core/bundles/files/bitstreams":
            self.send_bitstreams(root, int(query.get("page", 0)))
        elif name.startswith("core/bitstreams/"):
            self.send_part(read(name.split("/")[2]))
        else:
            self.head(404, 0)

    def send_bitstreams(self, root, page):
        names = sorted(name for name in os.listdir(FOLDER) if name.endswith(".zip"))
        url = f"{root}/core/bundles/files/bitstreams"
        streams = [{"uuid": name, "name": name, "type": "bitstream", "sizeBytes": len(read(name)), "sequenceId": 1,
                    "checkSum": {"checkSumAlgorithm": "MD5", "value": hashlib.md5(read(name)).hexdigest()},
                    "_links": {"content": {"href": f"{root}/core/bitstreams/{name}/content"}}} for name in names[2 * page:2 * page + 2]]
        links = {"self": {"href": f"{url}?page={page}"}}
        if 2 * page + 2 < len(names):
            links["next"] = {"href": f"{url}?page={page + 1}"}
        self.send_json({"_embedded": {"bitstreams": streams}, "_links": links,
                        "page": {"size": 2, "totalElements": len(names), "totalPages": (len(names) + 1) // 2, "number": page}})


class Ftp(socketserver.StreamRequestHandler):
    def handle(self):
        self.offset = 0
        self.reply("220 ready")
        for line in self.rfile:
            word, _, argument = line.decode().strip().partition(" ")
            method = getattr(self, "do_" + word.upper(), None)
            if method is None:
                self.reply("502 no")
            elif method(argument) is False:
                return

    def reply(self, text):
        self.wfile.write((text + "\r\n").encode())

    def do_USER(self, _):
        self.reply("331 password")

    def do_PASS(self, _):
        self.reply("230 welcome")

    def do_PWD(self, _):
        self.reply('257 "/"')

    def do_CWD(self, argument):
        self.way = argument
        self.reply("250 there")

    def do_TYPE(self, _):
        self.reply("200 ok")

    def do_SIZE(self, name):
        try:
            self.reply(f"213 {len(read(name))}")
        except FileNotFoundError:
            self.reply("550 no such file")

    def do_REST(self, argument):
        self.offset = int(argument)
        self.reply("350 from there")

    def do_EPSV(self, _):
        self.listener = socketserver.socket.create_server(("127.0.0.1", 0))
        self.reply(f"229 here (|||{self.listener.getsockname()[1]}|)")

    def do_RETR(self, name):
        try:
            data = read(name)[self.offset:]
        except FileNotFoundError:
            self.reply("550 no such file")
            return None
        self.reply("150 coming")
        connection, _ = self.listener.accept()
        connection.sendall(data[:CHUNK] if "broken" in self.way else data)
        connection.close()
        self.listener.close()
        self.offset = 0
        if "broken" in self.way and len(data) > CHUNK:
            return False
        self.reply("226 done")
        return None

    def do_QUIT(self, _):
        self.reply("221 bye")
        return False


class FtpServer(socketserver.ThreadingTCPServer):
    allow_reuse_address = True
    daemon_threads = True


def main():
    servers = [http.server.ThreadingHTTPServer(("127.0.0.1", 0), Http), FtpServer(("127.0.0.1", 0), Ftp)]
    for server in servers:
        threading.Thread(target=server.serve_forever, daemon=True).start()
    print(*[server.server_address[1] for server in servers], flush=True)
    sys.stdin.read()


if __name__ == "__main__":
    main()
