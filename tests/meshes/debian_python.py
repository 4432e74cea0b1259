"""The interpreter that has numpy, meshio and gmsh: Debian's, whatever python3 comes first in the PATH.

    import debian_python
    debian_python.take_over()    before numpy is imported: a script that another Python runs starts anew
    subprocess.run([debian_python.PYTHON, script])
"""

import os
import sys

DEBIAN = "/usr/bin/python3"
PYTHON = DEBIAN if os.access(DEBIAN, os.X_OK) else sys.executable


def take_over():
    """Starts the running script again in PYTHON, unless it runs there."""
    main = sys.modules["__main__"]
    if os.path.realpath(PYTHON) != os.path.realpath(sys.executable) and hasattr(main, "__file__"):
        os.execv(PYTHON, [PYTHON, "-B", main.__file__, *sys.argv[1:]])
