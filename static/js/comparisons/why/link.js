/**
 * A link by which others see the same what-if. The address in the bar opens for who played alone, so a key is asked for
 * first, the same every time.
 * @import {About} from "#js/comparisons/why/about.js"
 */
import { ApiError, api } from "#js/lib/api.js";
import { copyText } from "#js/lib/clipboard.js";

/** Copies it; what came of that, in a sentence. @param {About} about */
export async function copyLink(about) {
  try {
    const link = await linkTo(about);
    return (await copyText(link))
      ? "The link is copied: who opens it sees this comparison and this what-if."
      : `Your browser does not let this page copy. Here it is: ${link}`;
  } catch (error) {
    if (error instanceof ApiError) return error.message;
    throw error;
  }
}

/** @param {About} about */
async function linkTo({ runId, isOwn }) {
  if (!isOwn) return location.href;
  const { address } = await api.post(`/runs/${runId}/shares`, {});
  return new URL(address + location.hash, location.href).href;
}
