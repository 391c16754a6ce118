"""A server of the workbench in a thread, and how one asks it."""

import threading
import time
import urllib.error
import urllib.request

CSV = "torque [Nm];turning [arcsec]\n" + "\n".join(
    f"{t};{12 * t / 100 + 3 * (1 if k < 10 else -1):.3f}".replace(".", ",")
    for k, t in enumerate([*range(-160, 161, 32), *range(160, -161, -32)])
)


def started(folder):
    """The address of a server of the folder."""
    from workbench.server import serve

    told: list[str] = []
    threading.Thread(target=serve, args=(folder, 0, 1, told.append), daemon=True).start()
    end = time.monotonic() + 10.0
    while not told and time.monotonic() < end:
        time.sleep(0.01)
    return told[0]


def asked(address, path="", method="GET", body=None, **headers):
    """(status, body, headers)"""
    request = urllib.request.Request(address + path, body, headers, method=method)
    try:
        with urllib.request.urlopen(request, timeout=10) as answer:
            return answer.status, answer.read(), answer.headers
    except urllib.error.HTTPError as refused:
        return refused.code, refused.read(), refused.headers


def own(address):
    """Headers of a page of this server."""
    return {"Origin": address.rsplit("/", 2)[0]}
