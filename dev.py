#!/usr/bin/env python3
"""The four commands of this repository, for people and for CI. Needs Python 3.11 or newer and nothing else.

run    set up, then serve on http://127.0.0.1:8000             (IRLFR_PORT and the other settings: README.md)
test   set up, then run every test, browser tests included     (further arguments go to pytest)
check  format, lint, types, import contracts, docs
bench  measure: `bench core`, `play`, `rank`, `web`, or all; writes bench.json
"""

import sys

if sys.version_info < (3, 11):  # noqa: UP036 - an older Python shall read this sentence, not a traceback
    sys.exit("IRLFR needs Python 3.11 or newer; this is %d.%d. Try: python3.11 dev.py" % sys.version_info[:2])  # noqa: UP031

import contextlib
import hashlib
import json
import os
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

Command = Sequence[str | Path]

ROOT = Path(__file__).resolve().parent
VENV = ROOT / ".venv"
SCRIPTS = VENV / ("Scripts" if os.name == "nt" else "bin")
PYTHON = SCRIPTS / ("python.exe" if os.name == "nt" else "python")
STAMP = VENV / "irlfr-setup.json"
SIDE_BY_SIDE = ("-n", "2", "--dist", "loadfile", "--durations=25")
"""How the whole suite runs: a browser test is mostly waiting, and the tests of a file may share what they prepared."""
BROWSER_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


def main(arguments: list[str]) -> int:
    commands = {"run": run, "test": test, "check": check, "bench": bench}
    if not arguments or arguments[0] not in commands:
        print(__doc__)
        return 0 if not arguments or arguments[0] in {"-h", "--help", "help"} else 2
    os.chdir(ROOT)
    try:
        return commands[arguments[0]](arguments[1:])
    except SetupError as error:
        print(f"dev.py: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


def run(arguments: list[str]) -> int:
    set_up()
    command = [str(SCRIPTS / "irlfr"), "serve", *arguments]
    sys.stdout.flush()
    if os.name == "posix":
        os.execv(command[0], command)  # signals then reach the server itself  # noqa: S606
    return subprocess.run(command, check=False).returncode


def test(arguments: list[str]) -> int:
    set_up(dev=True)
    step("compile", [PYTHON, "-c", "import irl_core; irl_core.warm_up()"])  # once, rather than in every server at once
    return step("pytest", [PYTHON, "-m", "pytest", *(arguments or SIDE_BY_SIDE)], with_browser())


def check(_arguments: list[str]) -> int:
    set_up(dev=True)
    set_up_javascript_tools()
    node_bin = ROOT / "node_modules"
    steps: dict[str, Command] = {
        "format": [PYTHON, "-m", "ruff", "format", "--check", "--quiet", "."],
        "lint": [PYTHON, "-m", "ruff", "check", "."],
        "types": [PYTHON, "-m", "mypy"],
        "import contracts": [SCRIPTS / "lint-imports", "--no-logo"],
        "JavaScript types": [*node_command(), node_bin / "typescript" / "bin" / "tsc", "-p", "."],
        "JavaScript format and lint": [*node_command(), node_bin / "@biomejs" / "biome" / "bin" / "biome", "check"],
        "docs": [PYTHON, "-m", "pytest", "-q", "--no-header", "-p", "no:cacheprovider", "tests/test_docs.py"],
    }
    failed = [name for name, command in steps.items() if step(name, command) != 0]
    print(f"\ncheck: {', '.join(failed)} failed" if failed else "\ncheck: all clean")
    return 1 if failed else 0


def bench(arguments: list[str]) -> int:
    set_up(dev=True)
    return step("bench", [PYTHON, "-m", "bench", *arguments], with_browser())


def with_browser() -> dict[str, str]:
    """The environment, saying where the browser is."""
    chromium = find_chromium()
    return dict(os.environ) if chromium is None else os.environ | {"E2E_CHROMIUM": str(chromium)}


def step(name: str, command: Command, environment: dict[str, str] | None = None) -> int:
    """Run one command, saying what it is and how long it took."""
    print(f"── {name}", flush=True)
    started = time.monotonic()
    code = subprocess.run([str(part) for part in command], env=environment, check=False).returncode
    print(f"── {name}: {'ok' if code == 0 else f'failed ({code})'} in {time.monotonic() - started:.1f} s", flush=True)
    return code


# Set-up: everything lands in .venv, static/vendor and node_modules; what is done already is skipped, so that a second
# call works offline.


class SetupError(Exception):
    """Set-up cannot go on; the message says what to do."""


def set_up(*, dev: bool = False) -> None:
    """Make .venv with the locked requirements, the browser's packages, and the project itself, editable."""
    with only_one_at_a_time():
        make_environment()
        requirements = ["requirements/dev.txt"] if dev else ["requirements/runtime.txt", "requirements/build.txt"]
        if not is_done("dev", ["requirements/dev.txt"]):  # which holds the others too
            once("dev" if dev else "runtime", requirements, lambda: install_requirements(requirements))
        if not (shutil.which("node") and shutil.which("npm")):
            once("node", ["requirements/node.txt"], lambda: install_requirements(["requirements/node.txt"]))
        call("the browser's packages", [PYTHON, "hatch_build.py"])
        once("project", ["pyproject.toml", "hatch_build.py"], install_project)
        if dev:  # `run` serves pages at once; there the worker compiles when it starts
            kernels = sorted(str(path.relative_to(ROOT)) for path in ROOT.glob("irl_core/_kernels/*.py"))
            compile_them: Command = [PYTHON, "-c", "import irl_core; irl_core.warm_up()"]
            once("compiled kernels", kernels, lambda: compile_afresh(compile_them))


def set_up_javascript_tools() -> None:
    """Install TypeScript and biome into node_modules."""
    inputs = ["package.json", "package-lock.json"]
    if not (ROOT / "node_modules").is_dir():
        forget("javascript tools")
    with only_one_at_a_time():
        once(
            "javascript tools", inputs, lambda: call("TypeScript and biome", [*npm_command(), "ci", "--ignore-scripts"])
        )


def make_environment() -> None:
    if PYTHON.exists() and quietly([PYTHON, "-c", "import sys; sys.exit(sys.version_info < (3, 11))"]):
        return
    if VENV.exists():
        shutil.rmtree(VENV)  # made by a Python that is gone or too old
    if quietly([sys.executable, "-c", "import ensurepip, venv"]):
        call("virtual environment", [sys.executable, "-m", "venv", VENV])
    elif quietly([sys.executable, "-m", "pip", "--python", sys.executable, "--version"]):
        call("virtual environment", [sys.executable, "-m", "venv", "--without-pip", VENV])
    else:
        message = (
            "this Python has neither ensurepip nor pip. Install them (Debian: apt install python3-venv) and try again."
        )
        raise SetupError(message)


def install_requirements(files: list[str]) -> None:
    locked = [part for file in files for part in ("-r", file)]
    call(
        ", ".join(files),
        [*pip(), "install", "--quiet", "--no-deps", "--require-hashes", "--only-binary", ":all:", *locked],
    )


def install_project() -> None:
    call("the project", [*pip(), "install", "--quiet", "--no-deps", "--no-build-isolation", "--editable", "."])


def compile_afresh(command: Command) -> None:
    """Compile the kernels. Numba keeps what it compiled until its own file changes, even if one it imports did."""
    for kept in ROOT.glob("irl_core/_kernels/__pycache__/*.nb[ic]"):
        kept.unlink()
    call("compiled kernels", command)


def pip() -> Command:
    """The environment's own pip, or the system's working on the environment."""
    if quietly([PYTHON, "-m", "pip", "--version"]):
        return [PYTHON, "-m", "pip", "--disable-pip-version-check"]
    return [sys.executable, "-m", "pip", "--disable-pip-version-check", "--python", PYTHON]


def npm_command() -> list[str]:
    return ask_for_command("npm_command")


def node_command() -> list[str]:
    return ask_for_command("node_command")


def ask_for_command(function: str) -> list[str]:
    """Ask hatch_build.py, which only runs inside the environment, how to call a program of Node's."""
    code = f"import hatch_build, json; print(json.dumps(hatch_build.{function}()))"
    answer: list[str] = json.loads(subprocess.run([PYTHON, "-c", code], check=True, capture_output=True).stdout)
    return answer


def once(name: str, inputs: list[str], work: Callable[[], None]) -> None:
    """Do `work` unless it was done before with the same inputs."""
    if is_done(name, inputs):
        return
    forget(name)
    work()
    write_stamp(read_stamp() | {name: fingerprint(inputs)})


def is_done(name: str, inputs: list[str]) -> bool:
    return read_stamp().get(name) == fingerprint(inputs)


def forget(name: str) -> None:
    write_stamp({key: value for key, value in read_stamp().items() if key != name})


def fingerprint(inputs: list[str]) -> str:
    """The inputs' content, the place of the checkout (scripts in .venv name it) and the Python in .venv."""
    digest = hashlib.sha256(f"{ROOT}\n".encode() + (VENV / "pyvenv.cfg").read_bytes())
    for name in inputs:
        digest.update((ROOT / name).read_bytes())
    return digest.hexdigest()


def read_stamp() -> dict[str, str]:
    try:
        stamp: dict[str, str] = json.loads(STAMP.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return stamp


def write_stamp(stamp: dict[str, str]) -> None:
    if VENV.is_dir():
        STAMP.write_text(json.dumps(stamp, indent=2), encoding="utf-8")


@contextlib.contextmanager
def only_one_at_a_time() -> Iterator[None]:
    """Let a second dev.py wait until the first has set up."""
    try:
        import fcntl  # noqa: PLC0415 - not on Windows
    except ImportError:
        yield
        return
    (ROOT / "build").mkdir(exist_ok=True)
    with (ROOT / "build" / "setup.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def call(what: str, command: Command) -> None:
    """Run a step of the set-up, or stop with its output."""
    started = time.monotonic()
    done = subprocess.run([str(part) for part in command], check=False, capture_output=True, text=True, cwd=ROOT)
    if done.returncode != 0:
        raise SetupError(f"setting up {what} failed: {' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    if (seconds := time.monotonic() - started) > 1:
        print(f"set up {what} ({seconds:.0f} s)", flush=True)


def quietly(command: Command) -> bool:
    """Whether a command works."""
    with contextlib.suppress(OSError):
        return subprocess.run([str(part) for part in command], check=False, capture_output=True).returncode == 0
    return False


# The browser of the tests


def find_chromium() -> Path | None:
    """The browser to test with: E2E_CHROMIUM, playwright's own, the machine's, Debian's, or a fresh download."""
    if said := os.environ.get("E2E_CHROMIUM"):
        if not Path(said).is_file():
            raise SetupError(f"E2E_CHROMIUM says {said}, and no file is there.")
        return Path(said)
    return playwrights_chromium() or chromium_on_path() or debian_chromium() or downloaded_chromium()


def playwrights_chromium() -> Path | None:
    code = "from playwright.sync_api import sync_playwright as s\nwith s() as p: print(p.chromium.executable_path)"
    answer = subprocess.run([PYTHON, "-c", code], check=False, capture_output=True, text=True).stdout.strip()
    return Path(answer) if answer and Path(answer).is_file() else None


def chromium_on_path() -> Path | None:
    return next((Path(found) for name in BROWSER_NAMES if (found := shutil.which(name))), None)


def debian_chromium() -> Path | None:
    if os.name != "posix" or os.geteuid() != 0 or not shutil.which("apt-get"):
        return None
    print("installing Chromium from the system's packages", flush=True)
    apt = ["apt-get", "-qq", "-o", "DPkg::Lock::Timeout=120"]
    install = [*apt, "install", "-y", "--no-install-recommends", "chromium", "fonts-liberation"]
    environment = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
    for command in ([*apt, "update"], install):
        subprocess.run(command, check=False, env=environment, stdout=subprocess.DEVNULL)
    return chromium_on_path()


def downloaded_chromium() -> Path | None:
    print("downloading Chromium for playwright", flush=True)
    with contextlib.suppress(subprocess.TimeoutExpired):
        subprocess.run([PYTHON, "-m", "playwright", "install", "chromium"], check=False, timeout=600)
    return playwrights_chromium()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
