"""What the tests of pages have in common: the program, expectations, a browser and a folder to work in."""

import os
import shutil
import subprocess
import sys
import tempfile

from webdriver import Browser

program, pictures = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
passed = failed = 0


def expect(sentence, wanted, got):
    global passed, failed
    if wanted == got:
        passed += 1
    else:
        failed += 1
        print(f"FAILED: {sentence}\n  wanted {wanted!r}\n  got    {got!r}")


def relock(*arguments):
    """Exit status and what it complains of."""
    said = subprocess.run([program, *arguments], capture_output=True, text=True)
    return said.returncode, said.stderr


def main(test):
    if not shutil.which("chromedriver"):
        print("chromedriver is not installed: skipped")
        sys.exit(77)
    os.makedirs(pictures, exist_ok=True)
    with tempfile.TemporaryDirectory() as work, Browser() as browser:
        browser.requests()  # the browser's own first page
        test(browser, work)
    print(f"{passed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
