"""Progress of long calls: a callable, or a bar by tqdm."""
import contextlib

from ._errors import invalid_type


@contextlib.contextmanager
def telling(progress, function):
    """What the library calls: `progress` itself; a tqdm bar for True (nothing without tqdm); None."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            yield None
            return
        with tqdm(total=100, unit="%", bar_format="{desc:<10}{percentage:3.0f}% {bar} {elapsed}") as bar:
            def show(fraction, stage):
                bar.set_description_str(stage, refresh=False)
                bar.update(100 * fraction - bar.n)
            yield show
    elif callable(progress):
        yield progress
    else:
        raise invalid_type(function, "progress", progress, "True, False or a callable of (fraction, stage)")
