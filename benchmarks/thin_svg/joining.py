# SPDX-License-Identifier: MIT
"""Items that look the same when they are drawn as one element."""
COLOUR_STEP = 12  # of 255: colours along a line that differ by less become one


def near_colours(a, b):
    return all(abs(int(a[i:i + 2], 16) - int(b[i:i + 2], 16)) < COLOUR_STEP for i in (1, 3, 5))


def join_segments(items):
    """Segments of a line whose colour changes along it: one line as long as the colour is nearly the same."""
    result, palette = [], []
    for item in items:
        before = result[-1] if result else None
        if item.layer and item.layer.startswith("LineCollection") and item.kind == "path":
            colour = item.style["stroke"]
            item.style["stroke"] = next((known for known in palette if near_colours(known, colour)), colour)
            palette += [] if item.style["stroke"] in palette else [colour]
            if before and item.layer == before.layer and item.key() == before.key() \
                    and before.data[-1][-1][1][-1] == item.data[0][0][1][0]:
                before.data[-1] += item.data[0][1:]
                before.data += item.data[1:]
                continue
        result.append(item)
    return result


def box(item):
    points = [point for subpath in item.data for _, points in subpath for point in points]
    xs, ys = zip(*points)
    border = float(item.style.get("stroke-width", 1)) / 2 if "stroke" in item.style else 0
    return min(xs) - border, min(ys) - border, max(xs) + border, max(ys) + border


def can_be_one(items, item):
    """Whether paths of the same style look the same as one path: opaque lines always, others where they are apart."""
    if item.style.get("fill") == "none" and "stroke-opacity" not in item.style and "opacity" not in item.style:
        return True
    left, top, right, bottom = box(item)
    return all(other[2] < left or right < other[0] or other[3] < top or bottom < other[1] for other in map(box, items))


def grouped(items):
    """Groups of items with the same key: neighbours, and all of an axis."""
    groups = []
    for item in items:
        for group in reversed(groups):
            if group[0].key() == item.key() and (item.kind != "path" or item.layer or can_be_one(group, item)):
                group.append(item)
                break
            if item.layer is None or group[0].layer != item.layer:
                groups.append([item])
                break
        else:
            groups.append([item])
    return groups
