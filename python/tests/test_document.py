import doctest
import os
import re
from pathlib import Path


def test_the_examples_of_the_document_are_right():
    page = Path(os.environ["PSTRIPACK_SOURCES"], "docs/python.md").read_text()
    blocks = "\n".join(re.findall(r"(?ms)^```python\n(.*?)^```$", page))
    assert blocks.count(">>>") > 10
    test = doctest.DocTestParser().get_doctest(blocks, {}, "python.md", None, 0)
    failures = []
    doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test, out=failures.append)
    assert not failures, "".join(failures)
