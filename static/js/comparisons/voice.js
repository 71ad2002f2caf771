/**
 * How the page speaks of the person who played: to them, or, where a shared link was opened, of them.
 * @typedef {{ You: string, you: string, Your: string, your: string }} Voice
 */

/** @type {Voice} */
export const TO_YOU = { You: "You", you: "you", Your: "Your", your: "your" };
/** @type {Voice} */
const OF_THE_PLAYER = { You: "The player", you: "the player", Your: "The player's", your: "the player's" };

/** @param {boolean | undefined} isOwn whether the page is seen by who played */
export function voiceOf(isOwn = true) {
  return isOwn ? TO_YOU : OF_THE_PLAYER;
}
