// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Keeps turning smooth on slow graphics: while the camera moves and frames take long, edges are not
// smoothed and fewer points are drawn; as soon as it rests everything is.

const kSlow = 55; // ms a frame: above it there is less
const kQuick = 20; // below it there may be more
const kRest = 220; // ms without motion, more where frames take long
const kLongest = 1000;
const kLeast = 6;

export class Detail {
  constructor(redraw) {
    this.redraw = redraw;
    this.level = 0; // 0 everything, 1 without smoothing, then half of the points each time
    this.quick = 0;
    this.took = 0;
  }

  /** The camera was moved by a person. */
  moved() {
    clearTimeout(this.timer);
    this.moving = true;
    this.timer = setTimeout(
      () => {
        this.moving = false;
        this.last = null;
        this.redraw();
      },
      Math.max(kRest, 3 * this.took),
    );
  }

  /** What to draw in a frame that begins now [ms]: { smooth, share of the points }. */
  frame(now) {
    if (!this.moving) return { smooth: true, share: 1 };
    const took = this.last ? now - this.last : 0;
    this.took = Math.min(took, kLongest);
    this.last = now;
    this.quick = took > 0 && took < kQuick ? this.quick + 1 : 0;
    if (took > kSlow)
      this.level = Math.min(kLeast, this.level + Math.ceil(Math.log2(took / kSlow)));
    else if (this.quick > 20 && this.level > 0) {
      this.level -= 1;
      this.quick = 0;
    }
    return { smooth: this.level === 0, share: 2 ** -Math.max(0, this.level - 1) };
  }
}
