#!/usr/bin/env python3
"""Attacks the program: damaged parts of sweeps, runs killed at random instants in folders that hold another run, two
sweeps in one folder, output that cannot be written, inputs that never end, hostile names. Nothing may be lost, mixed or
believed in silence.

    adversary.py target/release/tune [--damaged 40] [--kills 20] [--pairs 8] [--mutated 40] [--seed 1]
"""

import argparse, hashlib, os, pathlib, random, shutil, signal, stat, subprocess, sys, tempfile, time

SWEEP = """
[sweep]
kind = "fragility"
seed = 5
part = 60
[[structure]]
kind = "aframe"
height_m = 12.0
width_m = 2.4
mass_kg = 350e3
[records]
el_centro = true
earthquakes = 20
[levels]
pga_g = { from = 0.1, to = 2.0, count = 12, spacing = "log" }
"""
CASES = {
    name: f'[structure]\nkind = "block"\nheight_m = {h}\nwidth_m = {w}\nmass_kg = 400.0\n'
    "[record]\nduration_s = 2.0\n[tuning]\naccuracy = 0.05\n"
    for name, h, w in [("a", 1.0, 0.5), ("b", 1.5, 0.6)]
}
QUICK = ["--quiet", "--no-front", "--no-figures"]

parser = argparse.ArgumentParser()
parser.add_argument("tune")
for name, default in [("damaged", 40), ("kills", 20), ("pairs", 8), ("mutated", 40), ("seed", 1)]:
    parser.add_argument(f"--{name}", type=int, default=default)
o = parser.parse_args()
tune = os.path.abspath(o.tune)
dice = random.Random(o.seed)
failures = []


def run(folder, *args, **more):
    return subprocess.run([tune, *args], cwd=folder, capture_output=True, timeout=120, **more)


def check(what, held, said=""):
    if not held:
        failures.append(what)
        print(f"FAILED: {what}: {said}")


def files(folder):
    """Every file below a folder, but for the list of what was written, with a hash of its bytes."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name != ".tune-files.json"
    }


def damage(parts):
    """One damage to a folder of parts, in words."""
    part, other = dice.sample(parts, 2)
    whole = part.read_bytes()
    at = dice.randrange(len(whole))
    kind = dice.choice(["bit", "bit", "bit", "cut", "copy", "swap", "gone", "zeros", "longer", "double"])
    if kind == "bit":
        part.write_bytes(whole[:at] + bytes([whole[at] ^ 1 << dice.randrange(8)]) + whole[at + 1 :])
    elif kind == "cut":
        part.write_bytes(whole[:at])
    elif kind == "copy":
        shutil.copy(other, part)
    elif kind == "swap":
        part.write_bytes(other.read_bytes())
        other.write_bytes(whole)
    elif kind == "gone":
        part.unlink()
    elif kind == "zeros":
        n = min(dice.randrange(1, 512), len(whole) - at)
        part.write_bytes(whole[:at] + bytes(n) + whole[at + n :])
        # zeros in place of zeros are no damage
        return kind if part.read_bytes() != whole else None
    elif kind == "longer":
        part.write_bytes(whole + dice.randbytes(dice.randrange(1, 64)))
    else:
        part.write_bytes(whole + whole)
    return f"{kind} {part.name}, byte {at} of {len(whole)}"


def damaged_parts(home):
    (home / "sweep.toml").write_text(SWEEP)
    whole = run(home, "sweep", "sweep.toml", "--out", "whole", "--quiet", "--no-figures")
    check("a sweep", whole.returncode == 0, whole.stderr)
    refused, silent = 0, 0
    for _ in range(o.damaged):
        shutil.rmtree(home / "damaged", ignore_errors=True)
        shutil.copytree(home / "whole", home / "damaged")
        what = damage(sorted((home / "damaged/parts").iterdir()))
        gather = run(home, "sweep", "gather", "sweep.toml", "--out", "damaged", "--no-figures")
        if what and gather.returncode == 0:
            silent += 1
            check("a damaged part", False, what + (" WRONG" if gather.stdout != whole.stdout else ""))
        elif what:
            refused += 1
            check("one line", len(gather.stderr.splitlines()) == 1, gather.stderr)
        if what and dice.random() < 0.2:
            again = run(home, "sweep", "sweep.toml", "--out", "damaged", "--quiet", "--no-figures")
            mended = again.returncode == 0 and files(home / "damaged") == files(home / "whole")
            check("a damaged part computed again", mended, f"{what}: {again.stderr}")
    print(f"damaged parts: {refused} refused, {silent} believed in silence")


def kills(home):
    for name, text in CASES.items():
        (home / f"{name}.toml").write_text(text)
        done = run(home, "run", f"{name}.toml", "--out", name, *QUICK)
        check("a run", done.returncode == 0, done.stderr)
    a, b = files(home / "a"), files(home / "b")
    began = time.monotonic()
    run(home, "run", "b.toml", "--out", "timed", *QUICK)
    seconds = time.monotonic() - began
    counts = dict.fromkeys(["old", "new", "marked", "mixed", "ended before"], 0)
    for i in range(o.kills):
        out = home / "killed"
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(home / "a", out)
        before = (out / "parameters.json").stat().st_mtime_ns, (out / "parameters.json").stat().st_ino
        child = subprocess.Popen([tune, "run", "b.toml", "--out", "killed", *QUICK], cwd=home, stdout=-3, stderr=-3)
        if i % 4 == 0:
            time.sleep(dice.random() * seconds)
        else:
            # from the first sign of writing on
            def writes():
                there = os.stat(out / "parameters.json")
                return any(out.glob(".unfinished-*")) or (there.st_mtime_ns, there.st_ino) != before

            while child.poll() is None and not writes():
                pass
            time.sleep(dice.random() * 0.02 * (i % 4))
        child.kill()
        if child.wait() == 0:
            counts["ended before"] += 1
        left = {name: sum_ for name, sum_ in files(out).items() if not name.startswith((".unfinished-", ".tmp"))}
        marked = any(name.startswith("UNFINISHED-") for name in left)
        if left == a or left == b:
            counts["old" if left == a else "new"] += 1
        elif marked:
            counts["marked"] += 1
            refused = run(home, "simulate", "--parameters", "killed/parameters.json")
            check("a mixture", refused.returncode == 2, refused.stderr)
        else:
            counts["mixed"] += 1
            check("a killed run", False, sorted(name for name in left if left[name] != a.get(name)))
        if i % 10 == 0:
            # the next run leaves the folder as if nothing had been
            run(home, "run", "b.toml", "--out", "killed", *QUICK)
            check("the run after a kill", files(out) == b, sorted(files(out)))
    print("kills:", ", ".join(f"{n} {what}" for what, n in counts.items()))


def pairs(home):
    whole = files(home / "whole")
    lost = 0
    for i in range(o.pairs):
        shutil.rmtree(home / "pair", ignore_errors=True)
        command = [tune, "sweep", "sweep.toml", "--out", "pair", "--quiet", "--no-figures", "--jobs", "1"]
        both = []
        for _ in range(2):
            both.append(subprocess.Popen(command, cwd=home, stdout=subprocess.PIPE, stderr=subprocess.PIPE))
            time.sleep(dice.random() * 0.02)
        said = [child.communicate() for child in both]
        held = all(child.returncode == 0 for child in both) and files(home / "pair") == whole
        lost += not held
        check("two sweeps in one folder", held, said)
    print(f"pairs: {o.pairs - lost} whole, {lost} lost")


def output(home):
    """Output that cannot be written costs no results."""
    full = open("/dev/full", "wb")
    commands = [["--version"], ["help", "run"], ["completions", "bash"], ["response", "--mu", "0.3"], ["housner"]]
    for args in commands:
        code = subprocess.run([tune, *args], cwd=home, stdout=full, stderr=subprocess.PIPE)
        check(f"{args} on a full disk", code.returncode == 2 and len(code.stderr.splitlines()) == 1, code)
        reader, writer = os.pipe()
        os.close(reader)
        code = subprocess.run([tune, *args], cwd=home, stdout=writer, stderr=subprocess.PIPE)
        os.close(writer)
        check(f"{args} into a closed pipe", code.returncode == 0 and b"anic" not in code.stderr, code)
    # a file of several components: its reader says on stderr which one is taken
    record = pathlib.Path(__file__).resolve().parent.parent / "tests/records/20161113_110259_WTMC_20.V2A"
    job = ["run", "a.toml", "--record", str(record), "--duration", "2", "--no-front", "--no-figures"]
    noticed = run(home, *job, "--out", "noticed")
    check("a record with a notice", noticed.returncode == 0 and noticed.stderr, noticed)
    expected = files(home / "noticed")
    for what in ["stdout", "stderr", "both"]:
        for closed in [False, True]:
            shutil.rmtree(home / "output", ignore_errors=True)
            reader, writer = os.pipe()
            os.close(reader)
            sink = writer if closed else full
            more = {name: sink if what in (name, "both") else subprocess.DEVNULL for name in ("stdout", "stderr")}
            code = subprocess.run([tune, *job, "--out", "output"], cwd=home, **more).returncode
            os.close(writer)
            there = (home / "output").is_dir() and files(home / "output") == expected
            check(
                f"run with {what} {'closed' if closed else 'full'}",
                there and code == (0 if closed else 2),
                (code, there),
            )
    print("output that cannot be written: done")


def inputs(home):
    """Inputs that never end, and names that steer a terminal."""
    os.mkfifo(home / "fifo")
    uses = [
        ["run", "{}"],
        ["run", "--record", "{}"],
        ["simulate", "--parameters", "{}"],
        ["record", "{}"],
        ["sweep", "{}"],
        ["verify", "--parameters", "{}"],
        ["housner", "{}"],
        ["validate", "--parameters", "a/parameters.json", "{}"],
    ]
    for name in ["fifo", "/dev/zero", "/dev/urandom", "/dev/tty", "."]:
        for use in uses:
            args = [word.format(name) for word in use]
            code = run(home, *args, "--out", "never") if use[0] != "record" else run(home, *args)
            check(f"{args}", code.returncode == 2 and code.stderr and b"panicked" not in code.stderr, code)
    hostile = "a\x1b[2Jb\x07c\u202ed\u2066e.txt"
    (home / hostile).write_text("# units: g\n" + "".join(f"{0.4 * (-1) ** (i // 25):.3f}\n" for i in range(300)))
    steers = [char.encode() for char in "\x1b\x07\u202e\u2066"]
    for args in [
        ["record", hostile, "--dt", "0.02"],
        ["run", "a.toml", "--record", hostile, "--dt", "0.02", "--out", "names", *QUICK],
        ["record", hostile + "x"],
        ["run", hostile + "x"],
        [hostile],
    ]:
        code = run(home, *args)
        for steer in steers:
            check(f"{args} on a terminal", steer not in code.stdout + code.stderr, code)
    for page in ["report.html", "parameters.md"]:
        text = (home / "names" / page).read_bytes()
        check(f"{page} with a hostile name", not any(steer in text for steer in steers))
    print("inputs that never end, hostile names: done")


WORDS = [
    "nan",
    "inf",
    "-1",
    "1e308",
    "1e-308",
    "0",
    "99999999999999999999",
    "[",
    "]",
    '"',
    "=",
    "\n",
    "\x00",
    "\u202e",
    "{",
    "}",
    ",",
    "true",
]


def mutated(text):
    """A text with some bytes changed, cut, doubled, or words put in."""
    data = bytearray(text)
    for _ in range(dice.choice([0, 1, 1, 2, 4, 16])):
        at, n = dice.randrange(len(data) + 1), dice.randrange(1, 40)
        kind = dice.randrange(5)
        if kind == 0 and at < len(data):
            data[at] ^= 1 << dice.randrange(8)
        elif kind == 1:
            del data[at : at + n]
        elif kind == 2:
            data[at:at] = data[at : at + n]
        elif kind == 3:
            data[at:at] = dice.choice(WORDS).encode()
        else:
            numbers = [i for i, byte in enumerate(data) if 48 <= byte <= 57]
            if numbers:
                i = dice.choice(numbers)
                data[i : i + 1] = dice.choice(WORDS).encode()
    return bytes(data)


def mutations(home):
    """Mutated files through the program: it ends, with one line where it refuses, in bounded memory,
    without a panic."""
    corpus = pathlib.Path(__file__).resolve().parent.parent / "fuzz/corpus"
    seeds = [
        (kind, path.read_bytes())
        for kind in ["case", "parameters", "record"]
        for path in sorted((corpus / kind).iterdir())
    ]
    seeds += [("sweep", SWEEP.encode())] * 20
    job = home / "mutated"
    job.mkdir()
    use = {
        "case": ["housner", "f", "--duration", "2"],
        "parameters": ["export", "--parameters", "f", "--format", "markdown", "--duration", "0.2", "--out", "x.md"],
        "record": ["record", "f"],
        "sweep": ["sweep", "f", "--out", "out", "--no-figures", "--quiet"],
    }
    counts, most, longest = {0: 0, 1: 0, 2: 0}, 0, 0.0
    for _ in range(o.mutated):
        kind, text = dice.choice(seeds)
        (job / "f").write_bytes(mutated(text))
        shutil.rmtree(job / "out", ignore_errors=True)
        began = time.monotonic()
        with open(job / "said", "w+b") as said:
            child = subprocess.Popen([tune, *use[kind]], cwd=job, stdout=subprocess.DEVNULL, stderr=said)
            deadline = began + 60
            while True:
                pid, status, used = os.wait4(child.pid, os.WNOHANG)
                if pid:
                    break
                if time.monotonic() > deadline:
                    child.kill()
                time.sleep(0.001)
            child.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0)
            text = said.read()
        most, longest = max(most, used.ru_maxrss / 1024), max(longest, time.monotonic() - began)
        code = child.returncode
        counts[code] = counts.get(code, 0) + 1
        held = code in (0, 2) and b"panicked" not in text and (code == 0 or len(text.splitlines()) == 1)
        if not held:
            kept = pathlib.Path(tempfile.mkdtemp(prefix="mutated-")) / kind
            shutil.copy(job / "f", kept)
            check("a mutated file", False, (kept, code, text))
    check("memory at most 1 GB", most < 1024, most)
    print(f"mutated files: exit codes {counts}, most memory {most:.0f} MB, longest {longest:.1f} s")


def slurm(home):
    """A shell runs what the Slurm files say, whatever the folder's name."""
    sweep, names = (
        home / "sweep.toml",
        ["two words", "it's; touch hurt", "$(touch hurt) `touch hurt`", 'a"b\\c', "-n", "%A é"],
    )
    for name in names:
        folder = home / "cluster" / name
        folder.mkdir(parents=True)
        shutil.copy(sweep, folder / "s.toml")
        out = folder / name
        code = run(folder, "sweep", "plan", "s.toml", f"--out={out}", "--slurm", "--shards", "2", "--quiet")
        check(f"plan in {name!r}", code.returncode == 0, code)
        bin_ = home / "bin"
        bin_.mkdir(exist_ok=True)
        (bin_ / "sbatch").write_text(
            "#!/bin/sh\nfor script; do :; done\nfor i in 1 2; "
            'do SLURM_ARRAY_TASK_ID=$i sh "$script" >&2 || exit 1; done\necho 7\n'
        )
        (bin_ / "sbatch").chmod(0o755)
        env = {**os.environ, "PATH": f"{bin_}:{os.environ['PATH']}"}
        done = subprocess.run(["sh", str(out / "submit.sh")], cwd="/", env=env, capture_output=True)
        check(f"submit in {name!r}", done.returncode == 0 and (out / "fragility.csv").exists(), done)
        check(f"a name that runs: {name!r}", not list(home.rglob("hurt")) and not pathlib.Path("/hurt").exists())
    bad = home / "cluster" / "line\ntouch hurt"
    code = run(home, "sweep", "plan", "sweep.toml", f"--out={bad}", "--slurm", "--quiet")
    check("a line's end in a name", code.returncode == 2 and len(code.stderr.splitlines()) == 1, code)
    print("names in Slurm files: done")


with tempfile.TemporaryDirectory() as folder:
    home = pathlib.Path(folder)
    for attack in [damaged_parts, kills, pairs, output, inputs, mutations, slurm]:
        began = time.monotonic()
        attack(home)
        print(f"  {time.monotonic() - began:.1f} s", flush=True)
print(f"{len(failures)} failures")
sys.exit(bool(failures))
