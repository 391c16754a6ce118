"""Saving what dropped files are taken for: it says that it is at work, waits its turn, and what is refused can be seen and tried again."""

from browser import dropped


def test_saving_says_at_once_that_it_is_at_work_and_can_be_clicked_again_where_it_was_refused(bench, tmp_path):
    """For seconds nothing moved."""
    page, held = dropped(bench, tmp_path), []
    page.select_option("#measured", "RV20E-121")
    page.get_by_role("combobox", name="locked").select_option("output")
    page.locator("#save:enabled").wait_for()

    def asked(route):
        held.append(route)

    page.route("**/in/save", asked)
    page.click("#save")
    page.locator("#save:disabled", has_text="Saving …").wait_for(timeout=500)
    assert page.locator("#saving progress").is_visible()
    while not held:
        page.wait_for_timeout(50)
    held[0].fulfill(status=400, json={"fault": "the disk is full"})
    page.get_by_text("the disk is full").wait_for()
    page.locator("#save:enabled", has_text="Save and compare").wait_for()
    assert page.locator("#saving progress").count() == 0
    page.unroute("**/in/save")
    page.click("#save")
    page.locator("#tab-look[aria-selected=true]").wait_for()
    assert (bench.folder / "campaign.toml").is_file()


def test_saving_waits_for_what_was_corrected_before(bench, tmp_path):
    """The answer to a correction that was still on its way cleared away why saving was refused."""
    page, corrections, saves = dropped(bench, tmp_path), [], []
    page.select_option("#measured", "RV20E-121")
    page.get_by_role("combobox", name="locked").select_option("output")
    page.locator("#save:enabled").wait_for()

    def correcting(route):
        corrections.append(route)

    def saving(route):
        saves.append(route)

    page.route("**/in/wishes", correcting)
    page.route("**/in/save", saving)
    page.get_by_role("combobox", name="locked").select_option("input")
    while not corrections:
        page.wait_for_timeout(50)
    page.click("#save")
    page.locator("#save:disabled", has_text="Saving …").wait_for()
    page.wait_for_timeout(200)
    assert not saves
    corrections[0].continue_()
    while not saves:
        page.wait_for_timeout(50)
    saves[0].fulfill(status=400, json={"fault": "the disk is full"})
    page.get_by_text("the disk is full").wait_for()
