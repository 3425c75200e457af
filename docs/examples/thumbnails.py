"""Thumbnails over HTTP, by burnish serve-stdio behind waitress (Debian: python3-waitress):

    waitress-serve --threads=8 --max-request-body-size=64000000 thumbnails:app
    curl --data-binary @part.stl http://localhost:8080/part.stl?size=256 -o part.png
"""
import itertools, json, os, struct, subprocess, threading, urllib.parse
from concurrent.futures import Future

burnish = subprocess.Popen(["burnish", "serve-stdio", "--max-seconds=10"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
numbers, waiting, lock = itertools.count(), {}, threading.Lock()

def receive():
    while head := burnish.stdout.read(8):
        length, number = struct.unpack("<II", head)
        line, picture = burnish.stdout.read(length).split(b"\n", 1)
        waiting.pop(number).set_result((json.loads(line), picture))
    os._exit(1)  # burnish has ended: whoever watches this process starts both again

def draw(mesh, **request):
    line, reply = json.dumps(request).encode() + b"\n", Future()
    with lock:
        number = next(numbers) & 0xFFFFFFFF
        waiting[number] = reply
        burnish.stdin.write(struct.pack("<II", len(line) + len(mesh), number) + line + mesh)
        burnish.stdin.flush()
    return reply.result()

def app(environ, start_response):
    size = urllib.parse.parse_qs(environ["QUERY_STRING"]).get("size", ["256"])[0]
    mesh = environ["wsgi.input"].read(int(environ.get("CONTENT_LENGTH") or 0))
    flags = ["--size=" + (size if size in ("64", "128", "256", "512") else "256")]
    reply, picture = draw(mesh, name=environ["PATH_INFO"].rsplit("/", 1)[-1] or "mesh", flags=flags)
    start_response("422 Unprocessable Entity" if reply["code"] else "200 OK",
                   [("Content-Type", "text/plain; charset=utf-8" if reply["code"] else "image/png")])
    return [picture or reply["error"].encode() + b"\n"]

threading.Thread(target=receive, daemon=True).start()
