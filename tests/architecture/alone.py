#!/usr/bin/env python3
"""alone.py BUILD: does each source compile by itself? A build without unity sources compiles it so, and a unity source
hides that one of its files lacks an include. Tests are built by clang where they are built together: here the
project's own compiler sees them, with its warnings.

Reads BUILD/compile_commands.json and checks the syntax of every 256th source of a unity source; which, goes on with
each commit. PAPERPROOF_LONG_TESTS=1: of all."""
import json, os, re, shlex, subprocess, sys

here = os.path.dirname(os.path.abspath(__file__))


def united(build):
    """Command without its files, and source: of all sources that are compiled together with others, each once."""
    seen = {}
    for entry in json.load(open(os.path.join(build, 'compile_commands.json'))):
        # What the sanitizers look at has the flags of another compiler.
        if not re.search(r'(?<!_sanitized)\.dir/Unity/unity_\d+_cxx\.cxx$|_tests_\d+\.cpp$', entry['file']):
            continue
        words = shlex.split(entry['command'])
        at = words.index('-o')
        command = [word for word in words[:at] + words[at + 2:] if word not in ('-c', entry['file'])]
        for source in re.findall(r'^#(?:include|line 1) "(.*\.cpp)"$', open(entry['file']).read(), re.MULTILINE):
            seen.setdefault(source, command)
    return sorted(seen.items())


def main():
    sources = united(sys.argv[1])
    assert len(sources) > 100, f'{len(sources)} sources are compiled together'
    step = 1 if os.environ.get('PAPERPROOF_LONG_TESTS') == '1' else 256
    commits = subprocess.run(['git', 'rev-list', '--count', 'HEAD'], cwd=here, capture_output=True, text=True).stdout
    chosen = sources[int(commits or 0) % step::step]
    failing = []
    for source, command in chosen:
        done = subprocess.run([*command, '-fsyntax-only', source], cwd=sys.argv[1], capture_output=True, text=True)
        if done.returncode != 0:
            failing.append(source)
            print(done.stderr[:2000])
    print(f'{len(chosen)} of {len(sources)} sources were compiled alone; {len(failing)} do not compile', *failing)
    sys.exit(bool(failing))


main()
