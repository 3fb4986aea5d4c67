"""Godot 3's KinematicBody2D (Debian's godot3-server): godot.gd beside this file, run without a window.

paperproof compare thin_platform --peer 'python3 compare/peers/godot.py'          # move_and_slide
paperproof compare thin_platform --peer 'python3 compare/peers/godot.py snap'     # move_and_slide_with_snap

A script in Godot 3 can read no pipe, and Godot prints a banner: so the lines go through a socket, with their lengths before
them, as StreamPeer has strings. Godot writes a log where it runs, and that is a folder for this run alone.
"""
import json
import os
import pathlib
import shutil
import socket
import struct
import subprocess
import sys
import tempfile


def pass_on(questions, answers):
    with socket.create_server(("127.0.0.1", 0)) as door, tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(__file__).resolve().with_suffix(".gd")
        surroundings = {**os.environ, "HOME": folder, "LANG": "en", "PAPERPROOF_PORT": str(door.getsockname()[1])}
        with subprocess.Popen(["godot3-server", "--fixed-fps", "60", "-s", script, *sys.argv[1:]], cwd=folder,
                              env=surroundings, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as godot:
            try:
                door.settimeout(30)
                link = door.accept()[0]
                link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                heard = link.makefile("rb")
                for question in questions:
                    link.sendall(struct.pack("<I", len(question)) + question)
                    answers.write(heard.read(*struct.unpack("<I", heard.read(4))) + b"\n")
                    answers.flush()
            finally:
                godot.kill()


if shutil.which("godot3-server"):
    pass_on(sys.stdin.buffer, sys.stdout.buffer)
else:
    print(json.dumps({"refuses": "install godot3-server first"}), flush=True)
