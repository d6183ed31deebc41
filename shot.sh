# shot.sh folder
for d in "$@"; do
chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=1400,2600 --screenshot=/tmp/pg/$d-1400.png file:///tmp/pg/$d/index.html >/dev/null 2>&1
chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=500,900 --screenshot=/tmp/pg/$d-500.png file:///tmp/pg/$d/index.html >/dev/null 2>&1
chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --blink-settings=preferredColorScheme=0 --window-size=1400,2600 --screenshot=/tmp/pg/$d-dark.png file:///tmp/pg/$d/index.html >/dev/null 2>&1
done
