"""What hypothesis draws: the same in every run, so that a failure is the change's and not the draw's.

    pytest tests/engine -m hypothesis --hypothesis-profile=others --hypothesis-seed=7

draws something else.
"""

from hypothesis import settings

settings.register_profile("same", derandomize=True, deadline=None, print_blob=True)
settings.register_profile("others", deadline=None, print_blob=True)
settings.load_profile("same")
