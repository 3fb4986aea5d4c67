#!/usr/bin/env python3
"""Which faults do the tests find? Draws small faults at random, puts one at a time into a copy of the project, builds
it, and runs the tests.

  faults.py draw [--seed N] > faults.json
      Eight faults for each part of the project, each an operator and a place drawn by the seed, and twelve spare ones
      for those that do not compile or change nothing.
  faults.py run FAULTS RESULTS [--full]
      RESULTS is a JSON file with one entry for each fault. A fault that has an entry is not run again.
      The copy and its build are in build/faults.
      --full: faults that the quick tests did not find meet the slow ones as well.
  faults.py table RESULTS
      One line for each fault, and how many were found.

Needs what `tests/run.sh` needs. A fault takes one to five minutes on two cores."""
import argparse, json, os, random, re, shutil, subprocess, sys, time
from pathlib import Path

project = Path(__file__).resolve().parents[2]
each, spare = 8, 12

# Where faults are put: a part, its folders, and what of them is left out.
parts = {
    'core': (['controller/src', 'controller/include'], []),
    'techniques': (['controller/techniques'], []),
    'adapter': (['box2d_adapter'], []),
    'oracle': (['compare/oracle'], []),
    'harness': (['compare'], ['compare/oracle', 'compare/benchmarks']),
}

# Name, pattern, replacement. The sources are formatted: blanks surround binary operators, and not template brackets.
turned = {'<': '>', '>': '<', '<=': '>=', '>=': '<=', '==': '!=', '!=': '=='}
operators = [
    ('comparison', r'(?<= )(<|>|<=|>=|==|!=)(?= )', lambda m: turned[m[0]]),
    ('sign', r'(?<=[\w)\]] )[+-](?= [\w(])', lambda m: '-' if m[0] == '+' else '+'),
    ('sign of one', r'(?<=[(=,?:] )-(?=[\w(])|(?<=[(])-(?=[a-z(])|(?<=return )-(?=[a-z(])', lambda m: ''),
    ('tolerance', r'\b\d+(\.\d+)?e-\d+\b', lambda m: f'{float(m[0]) * 10:g}'),
    ('filter dropped', r'^\s*if \(.*\) continue;$', lambda m: ''),
    ('early return removed', r'^\s*if \(.*\) return( .*)?;$', lambda m: ''),
    ('loop one short', r'(?<=; )(\w+)(?= < [\w.()]+; )', lambda m: m[0] + ' + 1'),
    ('cases swapped', r'(?<=\? )([^?:;()]+) : ([^?:;,()]+)(?=[;,)])', lambda m: f'{m[2]} : {m[1]}'),
    ('and, or', r'(?<= )(&&|\|\|)(?= )', lambda m: '||' if m[0] == '&&' else '&&'),
    ('not dropped', r'(?<=[ (])!(?=[a-z(])', lambda m: ''),
    ('least, most', r'\bstd::(min|max)(?=[(<])', lambda m: 'std::max' if m[1] == 'min' else 'std::min'),
    ('unit', r'(?<=[\w)]) [*/] [a-z_]\w*(?=[;),])', lambda m: ''),
    ('number', r'(?<=[ (])([2-9]|\d\d+|\d+\.\d+)(?=[ ;),])', lambda m: repr(3 * (float(m[0]) if '.' in m[0] else int(m[0])))),
]
# Of these lines none is changed: they are not code, or code of the compiler.
passed_over = re.compile(r'^\s*(//|#|\*|template|static_assert|using |namespace |friend )|static_assert|operator|concept ')


def sources(part):
    """Paths within the project."""
    folders, left_out = parts[part]
    for folder in folders:
        paths = [path.relative_to(project) for path in (project / folder).rglob('*.[ch]pp')]
        kept = [path for path in paths if not any(path.is_relative_to(out) for out in left_out)]
        yield from sorted(kept, key=lambda path: (str(path.parent), path.name))


def changes_of(line):
    """All changes of a line: operator, line after it. Neither text between quotes nor comments change."""
    code = re.sub(r'"(\\.|[^"\\])*"|//.*', lambda m: '\0' * len(m[0]), line)
    if passed_over.search(line):
        return
    for name, pattern, replace in operators:
        for match in re.finditer(pattern, code):
            if '\0' not in match[0] or name in ('filter dropped', 'early return removed'):
                yield name, line[:match.start()] + replace(match) + line[match.end():]


def draw(seed):
    """Faults of every part, in the order in which they are tried: operators by turns, as they are drawn."""
    drawn = []
    for part in parts:
        dice = random.Random(f'{seed} {part}')
        by_operator = {}
        for path in sources(part):
            for number, line in enumerate((project / path).read_text().split('\n'), 1):
                for name, after in changes_of(line):
                    by_operator.setdefault(name, []).append((str(path), number, line, after))
        turn = []
        for number in range(each + spare):
            if not turn:
                turn = sorted(by_operator)
                dice.shuffle(turn)
            operator = turn.pop()
            path, line, before, after = dice.choice(by_operator[operator])
            drawn.append({'part': part, 'number': number, 'operator': operator, 'path': path, 'line': line, 'before': before, 'after': after})
    return {'seed': seed, 'each': each, 'faults': drawn}


class Copy:
    """A copy of the project with a build of its own."""

    def __init__(self, full):
        self.folder = project / 'build/faults'
        self.build = self.folder / 'build/release'
        tracked = subprocess.run(['git', 'ls-files', '-z'], cwd=project, check=True, capture_output=True, text=True).stdout
        for path in filter(None, tracked.split('\0')):
            to, of = self.folder / path, project / path
            to.parent.mkdir(parents=True, exist_ok=True)
            if of.exists() and not (to.exists() and to.read_bytes() == of.read_bytes()):
                shutil.copy(of, to)
        if not self.build.exists():
            settings = subprocess.run(['bash', '-c', '. compare/packages.sh; printf "%s\n" "${whole_build[@]}"'], cwd=self.folder,
                                      check=True, capture_output=True, text=True).stdout.split()
            subprocess.run(['cmake', '--preset', 'release', *settings], cwd=self.folder, check=True, stdout=sys.stderr)
        assert self.compiles(), 'the project does not build without a fault'
        self.longest = {'quick': 3600, 'slow': 3600}  # seconds
        for tests in ('quick', 'slow') if full else ('quick',):
            begin = time.time()
            failing = self.failing(tests, every=True)
            assert not failing, f'without a fault there fail {failing}'
            self.longest[tests] = 60 + 4 * (time.time() - begin)

    def compiles(self):
        built = subprocess.run(['cmake', '--build', self.build, '--parallel'], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        # A build lists the tests of each program: one that cannot say them is there, and its tests fail.
        return built.returncode == 0 or 'Error running test executable' in built.stdout

    def failing(self, tests, every=False):
        """Names of the tests that fail, all or one; a fault may as well keep one from ending. @param tests quick or slow."""
        command = ['ctest', '--test-dir', self.build, '--no-tests=error', '--parallel', str(len(os.sched_getaffinity(0))),
                   '--timeout', '180',  # [s]; the slowest test takes a fifth of it
                   *(['--label-exclude', '^(slow|sanitized|windows)$'] if tests == 'quick' else ['--label-regex', '^slow$']),
                   *([] if every else ['--stop-on-failure'])]
        steps = {'PAPERPROOF_GUARANTEE_STEPS': '500'} if tests == 'quick' else {}  # as `tests/run.sh --quick`
        running = subprocess.Popen(command, env={**os.environ, **steps}, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                   start_new_session=True)
        try:
            said, _ = running.communicate(timeout=self.longest[tests])
        except subprocess.TimeoutExpired:
            subprocess.run(['pkill', '-KILL', '--session', str(running.pid)], check=False)
            said = running.communicate()[0] + '\nTest #0: no_end ***'
        failing = re.findall(r'Test\s+#\d+: (.*?) \.*\s*\*\*\*(?!Skipped|Not Run)', said)
        assert failing or running.returncode == 0, f'no test fails, and ctest ends with {running.returncode}:\n{said[-2000:]}'
        return failing


def put(copy, fault):
    """Puts a fault into the copy. Lines may have moved since it was drawn. @return the text without it, or None."""
    path = copy.folder / fault['path']
    if not path.exists():
        return None
    text = path.read_text()
    lines = text.split('\n')
    places = [number for number, line in enumerate(lines) if line == fault['before']]
    if not places:
        return None
    lines[min(places, key=lambda number: abs(number + 1 - fault['line']))] = fault['after']
    path.write_text('\n'.join(lines))
    return text


def try_fault(copy, fault, full):
    if fault['after'] == fault['before']:
        return {**fault, 'no_fault': 'changes nothing'}  # three times 0.0
    before = put(copy, fault)
    if before is None:
        return {**fault, 'no_fault': 'its line is no more'}
    try:
        if not copy.compiles():
            return {**fault, 'no_fault': 'does not compile'}
        begin = time.time()
        found, how = copy.failing('quick'), 'quick'
        if full and not found:
            found, how = copy.failing('slow'), 'full'
        return {**fault, 'found': how if found else None, 'tests': found, 'seconds': round(time.time() - begin)}
    finally:
        (copy.folder / fault['path']).write_text(before)


def run(drawn, path, full):
    results = json.loads(path.read_text()) if path.exists() else []
    tried = {(r['part'], r['number']): r for r in results}
    copy = Copy(full)
    for fault in drawn['faults']:
        key = fault['part'], fault['number']
        old = tried.get(key)
        is_enough = sum(part == fault['part'] and 'no_fault' not in r for (part, _), r in tried.items()) == drawn['each']
        meets_more = old and full and old['tried'] != 'full' and not old.get('found') and 'no_fault' not in old
        if (old and not meets_more) or (not old and is_enough):
            continue
        result = tried[key] = {**try_fault(copy, fault, full), 'tried': 'full' if full else 'quick'}
        path.write_text(json.dumps([*tried.values()], indent=1))
        print(*key, fault['operator'], result.get('found'), *result.get('tests', [])[:1], flush=True)


def table(results):
    tried = [r for r in results if 'no_fault' not in r]
    for r in tried:
        words = f"{r['found'] or 'survives'} {r['seconds']} s {''.join(r['tests'][:1])}"
        print(f"{r['part']} {r['number']} {r['operator']}, {r['path']}:{r['line']} | {words}")
    quick = sum(r['found'] == 'quick' for r in tried)
    print(f"of {len(tried)} faults {sum(bool(r['found']) for r in tried)} are found, {quick} of them by the quick tests")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_subparsers(dest='what', required=True)
    what.add_parser('draw').add_argument('--seed', type=int, default=1)
    running = what.add_parser('run')
    running.add_argument('faults', type=Path)
    running.add_argument('results', type=Path)
    running.add_argument('--full', action='store_true')
    what.add_parser('table').add_argument('results', type=Path)
    given = parser.parse_args()
    if given.what == 'draw':
        json.dump(draw(given.seed), sys.stdout, indent=1)
    elif given.what == 'run':
        run(json.loads(given.faults.read_text()), given.results, given.full)
    else:
        table(json.loads(given.results.read_text()))


if __name__ == '__main__':
    main()
