"""The typed example gives the expected results."""

import typed


def test_the_typed_example_runs():
    leaks, largest, ssim = typed.main()
    assert leaks > 0 and largest == 65504.0 and ssim == 1.0
