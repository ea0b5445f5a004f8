"""A page opened in the browser of the tests; all that it says or asks for is kept."""

FLAGS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--ignore-gpu-blocklist"]
READY = "html[data-state=ready]"


def opened(browser, address, **context):
    page = browser.new_context(viewport={"width": 1280, "height": 800}, **context).new_page()
    page.said = []
    page.on("console", lambda message: page.said.append(message.text))
    page.on("pageerror", lambda error: page.said.append(str(error)))
    page.on("request", lambda request: page.said.append(request.url) if request.url != address else None)
    page.goto(address)
    page.wait_for_selector(READY, timeout=60_000)
    return page
