"""fetch_source_archive.py NAME VERSION SHA256 FOLDER: downloads NAME-VERSION.tar.gz from pip's package index into FOLDER.

`pip download` would run the archive's build to read its metadata, with whatever build tools are the newest that day. This
runs nothing. It asks pip's own client, so that pip's configuration holds: index, proxy, certificates, find-links.
"""
import hashlib
import pathlib
import sys

from pip._internal.commands import create_command  # not a stable interface: tried with pip 20.3 to 25.3
from pip._internal.exceptions import CommandError

name, version, sha256, folder = sys.argv[1:]
archive = f"{name}-{version}.tar.gz"


class Fetch(type(create_command("download"))):
    def run(self, options, args):
        session = self.get_default_session(options)
        found = self._build_package_finder(options, session).find_all_candidates(name)
        links = [candidate.link for candidate in found if candidate.link.filename == archive]
        if not links:
            raise CommandError(f"pip's package index has no {archive}")
        response = session.get(links[0].url_without_fragment, headers={"Accept-Encoding": "identity"})
        response.raise_for_status()
        if hashlib.sha256(response.content).hexdigest() != sha256:
            raise CommandError(f"{archive} has not the expected sha256 {sha256}: not used")
        pathlib.Path(folder, archive).write_bytes(response.content)
        return 0


sys.exit(Fetch("download", "").main(["--quiet", "--no-binary", ":all:", name]))
