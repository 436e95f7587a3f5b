"""Runs the fuzzers of the preset `fuzz`, says what they found, and which lines of readers and decoders they reach.

usage: fuzz.py [--seconds S] [--seed N] [--patience S] [--coverage] [--keep] [HARNESS...]

Each harness runs until it has had its share of S seconds of a processor, which takes longer where others have their
turns; under the sanitizers, 10 seconds (--patience, for a process that seldom gets its turn) and 1 GiB an input at most,
from the kept corpus and what earlier runs found (build/fuzz/found). --keep takes of what was found what reaches more into
the corpus.
"""
import argparse
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/fuzz"
CORPUS = ROOT / "tests/fuzz/corpus"
FOUND = BUILD / "found"
LONGEST = {"ply": 4096, "lines": 4096, "materials": 2048, "gltf": 8192, "image": 4096, "model": 16384, "page": 8192, "json": 4096}  # bytes
KEPT = 40  # inputs of a harness, the shortest first
INTERRUPTED = 72  # how libFuzzer ends at a signal: nothing was found until then

# What is claimed to be covered: all that reads a file from outside.
READERS = ("preprocess/read/", "src/hierarchy/codec/", "src/hierarchy/file_layout", "src/hierarchy/model_file", "src/hierarchy/page_codec",
           "src/hierarchy/table_validation", "src/hierarchy/validation", "src/core/json_file", "src/path/camera_path", "src/bench/result_json",
           "src/theory/rows")  # fmt: skip


def environment(**more):
    options = "abort_on_error=0:detect_leaks=1:allocator_may_return_null=0"
    suppressed = f"suppressions={ROOT}/tests/sanitizers/lsan.supp:print_suppressions=0"
    return dict(os.environ, ASAN_OPTIONS=options, UBSAN_OPTIONS="print_stacktrace=1", LSAN_OPTIONS=suppressed, **more)


def program(name):
    return BUILD / "tests/fuzz" / f"fuzz_{name}"


def processor_seconds(process):
    """That a running process has had so far."""
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def fuzz(name, seconds, seed, patience):
    """Whether nothing was found."""
    found, artifacts, log = FOUND / name, BUILD / "artifacts" / name, BUILD / f"{name}.log"
    found.mkdir(parents=True, exist_ok=True)
    artifacts.mkdir(parents=True, exist_ok=True)
    with log.open("wb") as to:
        running = subprocess.Popen(
            [program(name), found, CORPUS / name, f"-seed={seed}", f"-timeout={patience}", "-rss_limit_mb=1024",
             f"-max_len={LONGEST[name]}", "-print_final_stats=1", "-use_value_profile=1", f"-artifact_prefix={artifacts}/"],
            stdout=to, stderr=subprocess.STDOUT, env=environment(LLVM_PROFILE_FILE="/dev/null"))  # fmt: skip
        used = 0
        while running.poll() is None:
            used = processor_seconds(running.pid)
            if used >= seconds:
                running.send_signal(signal.SIGINT)
                running.wait()
            time.sleep(0.2)
    passed = running.returncode in (0, INTERRUPTED)
    told = log.read_text(errors="replace")
    executed = re.findall(r"number_of_executed_units: (\d+)", told) or ["?"]
    reached = re.findall(r" cov: (\d+) ft: (\d+) corp: (\d+)", told) or [("?", "?", "?")]
    print(f"{name}: {used:.0f} s, {executed[-1]} inputs, {reached[-1][0]} edges, corpus of {reached[-1][2]}, "
          f"{'nothing found' if passed else 'FOUND SOMETHING'}", flush=True)  # fmt: skip
    if not passed:
        lines = [line for line in told.splitlines() if re.search(r"ERROR|SUMMARY|runtime error|Test unit|terminate", line)]
        print("\n".join("  " + line for line in lines[-8:]), flush=True)
    return passed


def keep(name):
    """Takes what reaches more than the kept corpus into it."""
    merged = BUILD / "merged" / name
    merged.mkdir(parents=True, exist_ok=True)
    before = set(path.name for path in (CORPUS / name).iterdir())
    subprocess.run([program(name), "-merge=1", "-timeout=10", "-rss_limit_mb=1024", CORPUS / name, FOUND / name],
                   check=True, capture_output=True, env=environment(LLVM_PROFILE_FILE="/dev/null"))  # fmt: skip
    new = sorted((path for path in (CORPUS / name).iterdir() if path.name not in before), key=lambda path: path.stat().st_size)
    for path in new[KEPT:]:
        path.unlink()
    for path in new[:KEPT]:
        path.rename(path.with_name(path.name[:16] + ".seed"))
    print(f"{name}: {min(len(new), KEPT)} of {len(new)} inputs kept besides {len(before)}")


def coverage(names):
    """The share of lines of the readers that corpora reach."""
    profiles = []
    for name in names:
        profile = BUILD / f"{name}.profraw"
        subprocess.run([program(name), "-runs=0", CORPUS / name, *([FOUND / name] if (FOUND / name).exists() else [])],
                       check=True, capture_output=True, env=environment(LLVM_PROFILE_FILE=str(profile)))  # fmt: skip
        profiles.append(profile)
    merged = BUILD / "all.profdata"
    subprocess.run(["llvm-profdata-14", "merge", "-sparse", *profiles, "-o", merged], check=True)
    objects = [word for name in names for word in ("-object", program(name))][1:]
    told = subprocess.run(["llvm-cov-14", "export", "-summary-only", f"-instr-profile={merged}", *objects],
                          check=True, capture_output=True, text=True).stdout  # fmt: skip
    rows = {}
    for path, count, covered in re.findall(
        r'"filename":"([^"]+)".*?"lines":\{"count":(\d+),"covered":(\d+)', told.replace(" ", "")
    ):
        relative = os.path.normpath(path).removeprefix(str(ROOT) + "/")  # kernels include themselves by another way
        if relative.startswith(READERS) and int(count) > 0:
            rows[relative] = (int(covered), int(count))
    for path, (covered, count) in sorted(rows.items(), key=lambda row: row[1][0] / row[1][1]):
        print(f"{covered / count:7.1%} {covered:5} of {count:5} {path}")
    covered, count = (sum(row[i] for row in rows.values()) for i in (0, 1))
    print(f"{covered / count:7.1%} {covered:5} of {count:5} lines of all")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--patience", type=int, default=10)
    parser.add_argument("--coverage", action="store_true")
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("harness", nargs="*", choices=[*LONGEST, []])
    given = parser.parse_args()
    names = given.harness or list(LONGEST)
    passed = True
    if given.seconds > 0:
        for name in names:
            passed &= fuzz(name, max(1, given.seconds // len(names)), given.seed, given.patience)
    if given.keep:
        for name in names:
            keep(name)
    if given.coverage:
        coverage(names)
    sys.exit(0 if passed else 1)


if __name__ == "__main__":
    main()
