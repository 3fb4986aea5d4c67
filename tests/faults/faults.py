#!/usr/bin/env python3
"""Which faults do the tests find? Draws small faults at random, puts one at a time into a copy of the project, builds
it, and runs the tests.

  faults.py draw [--seed N] [--each N] [--spare N] > faults.json
      N faults for each part of the project, each an operator and a place drawn by the seed, and spare ones for those
      that do not compile or change nothing.
  faults.py run FAULTS RESULTS [--into FOLDER] [--full]
      RESULTS is a JSON file with one entry for each fault. A fault that has an entry is not run again.
      FOLDER (build/faults) gets the copy and its build.
      --full: faults that the quick tests did not find meet the slow ones as well.
  faults.py table RESULTS...
      One line for each fault, and how many were found; of several files, side by side.

Needs what `tests/run.sh` needs. A fault takes one to five minutes on two cores."""
import argparse, json, os, random, re, shutil, subprocess, sys, time

here = os.path.dirname(os.path.abspath(__file__))
project = os.path.dirname(os.path.dirname(here))

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
    folders, left_out = parts[part]
    for folder in folders:
        for at, _, files in sorted(os.walk(os.path.join(project, folder))):
            path = os.path.relpath(at, project)
            if any(path == out or path.startswith(out + '/') for out in left_out):
                continue
            yield from (os.path.join(path, name) for name in sorted(files) if name.endswith(('.cpp', '.hpp')))


def changes_of(line):
    """All changes of a line: operator, line after it. Neither text between quotes nor comments change."""
    code = re.sub(r'"(\\.|[^"\\])*"|//.*', lambda m: '\0' * len(m[0]), line)
    if passed_over.search(line):
        return
    for name, pattern, replace in operators:
        for match in re.finditer(pattern, code):
            if '\0' not in match[0] or name in ('filter dropped', 'early return removed'):
                yield name, line[:match.start()] + replace(match) + line[match.end():]


def draw(seed, each, spare):
    """`each` + `spare` faults of every part, in the order in which they are tried: operators by turns, as they are drawn."""
    drawn = []
    for part in parts:
        dice = random.Random(f'{seed} {part}')
        by_operator = {}
        for path in sources(part):
            with open(os.path.join(project, path)) as file:
                for number, line in enumerate(file.read().split('\n'), 1):
                    for name, after in changes_of(line):
                        by_operator.setdefault(name, []).append((path, number, line, after))
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

    def __init__(self, folder, full):
        self.folder = os.path.abspath(folder)
        self.build = os.path.join(self.folder, 'build/release')
        os.makedirs(self.folder, exist_ok=True)
        tracked = subprocess.run(['git', 'ls-files', '-z'], cwd=project, check=True, capture_output=True, text=True).stdout
        for path in filter(None, tracked.split('\0')):
            to, of = os.path.join(self.folder, path), os.path.join(project, path)
            if not os.path.exists(of):
                continue
            os.makedirs(os.path.dirname(to), exist_ok=True)
            if not os.path.exists(to) or open(to, 'rb').read() != open(of, 'rb').read():
                shutil.copy(of, to)
        if not os.path.exists(self.build):
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
    path = os.path.join(copy.folder, fault['path'])
    if not os.path.exists(path):
        return None
    text = open(path).read()
    lines = text.split('\n')
    places = [number for number, line in enumerate(lines) if line == fault['before']]
    if not places:
        return None
    lines[min(places, key=lambda number: abs(number + 1 - fault['line']))] = fault['after']
    with open(path, 'w') as file:
        file.write('\n'.join(lines))
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
        with open(os.path.join(copy.folder, fault['path']), 'w') as file:
            file.write(before)


def run(drawn, path, folder, full):
    results = json.load(open(path)) if os.path.exists(path) else []
    copy = Copy(folder, full)
    for part in parts:
        mine = [fault for fault in drawn['faults'] if fault['part'] == part]
        for fault in mine:
            done = [r for r in results if r['part'] == part]
            old = [r for r in done if r['number'] == fault['number']]
            if old and not (full and not old[0].get('found') and old[0].get('tried') != 'full' and 'no_fault' not in old[0]):
                continue
            if not old and sum('no_fault' not in r for r in done) == drawn['each']:
                break
            result = try_fault(copy, fault, full)
            result['tried'] = 'full' if full else 'quick'
            results = [r for r in results if r not in old] + [result]
            with open(path, 'w') as file:
                json.dump(results, file, indent=1)
            print(part, fault['number'], fault['operator'], result.get('found'), *result.get('tests', [])[:1], flush=True)


def table(files):
    runs = [[r for r in json.load(open(path)) if 'no_fault' not in r] for path in files]
    for result in runs[0]:
        same = [next((r for r in other if (r['part'], r['number']) == (result['part'], result['number'])), {}) for other in runs]
        words = ['not run' if not r else f"{r.get('found') or 'survives'} {r.get('seconds', 0)} s {(r.get('tests') or [''])[0]}" for r in same]
        print(f"{result['part']} {result['number']} {result['operator']}, {result['path']}:{result['line']} | {' | '.join(words)}")
    for path, results in zip(files, runs):
        quick = sum(r.get('found') == 'quick' for r in results)
        print(f"{path}: of {len(results)} faults {sum(bool(r.get('found')) for r in results)} are found, {quick} of them by the quick tests")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_subparsers(dest='what', required=True)
    drawing = what.add_parser('draw')
    for name, value in (('--seed', 1), ('--each', 8), ('--spare', 12)):
        drawing.add_argument(name, type=int, default=value)
    running = what.add_parser('run')
    running.add_argument('faults')
    running.add_argument('results')
    running.add_argument('--into', default=os.path.join(project, 'build/faults'))
    running.add_argument('--full', action='store_true')
    what.add_parser('table').add_argument('results', nargs='+')
    given = parser.parse_args()
    if given.what == 'draw':
        json.dump(draw(given.seed, given.each, given.spare), sys.stdout, indent=1)
    elif given.what == 'run':
        run(json.load(open(given.faults)), given.results, given.into, given.full)
    else:
        table(given.results)


if __name__ == '__main__':
    main()
